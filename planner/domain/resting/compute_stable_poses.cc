#include "planner/domain/resting/compute_stable_poses.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/resting/face_contact.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {
namespace {

// Returns the turn of the part, at yaw 0, that makes `down` (unit, part frame) point down.
geometry::Matrix3 RestingRotation(const Vector3& down) {
  const double upright = std::cos(std::numbers::pi / 4) - kRounding;
  int axis = 0;
  while (std::abs(down[axis]) >= upright) ++axis;  // at most one axis is this upright
  const Vector3 up = -down;
  const Vector3 along = Vector3::Unit(axis);
  const Vector3 x = (along - along.dot(up) * up).normalized();
  geometry::Matrix3 R_TablePart;
  R_TablePart << x.transpose(), up.cross(x).transpose(), up.transpose();
  return R_TablePart;
}

geometry::Polygon SupportOf(const PartModel& part, const geometry::Facet& facet,
                            const Pose& X_TablePart) {
  std::vector<Vector2> touches;
  for (int vertex : facet.loop) {
    const Vector3 touch = TrueTouch(part, part.hull().vertices[vertex], facet.normal);
    touches.push_back((X_TablePart * touch).head<2>());
  }
  return geometry::Hull2(touches);
}

// Returns the features that the table touches or covers when it lies against a facet. A facet
// without a face rests on edges and corners, which hide nothing.
std::vector<FeatureNumber> HiddenUnder(const PartModel& part, const geometry::Facet& facet) {
  const FaceId id = FindFace(part.faces(), facet.normal, facet.offset);
  if (id.IsNone()) return {};
  std::vector<Vector3> corners;
  for (int vertex : facet.loop) corners.push_back(part.corners()[vertex]);
  return part.FeaturesUnder(id, OnFace(part.faces()[id.index()], corners));
}

std::optional<StablePose> RestOn(const PartModel& part, const geometry::Facet& facet,
                                 double least_tilt) {
  StablePose pose;
  pose.X_TablePart = Pose::Identity();
  pose.X_TablePart.linear() = RestingRotation(facet.normal);
  pose.X_TablePart.translation().z() = facet.offset;
  pose.support = SupportOf(part, facet, pose.X_TablePart);
  const Vector3 center = pose.X_TablePart * part.mass().center;
  pose.tilt_margin = std::atan2(geometry::Depth(pose.support, center.head<2>()), center.z());
  if (pose.tilt_margin < least_tilt) return std::nullopt;
  pose.hidden = HiddenUnder(part, facet);
  return pose;
}

}  // namespace

std::vector<StablePose> ComputeStablePoses(const PartModel& part, double least_tilt) {
  std::vector<StablePose> poses;
  for (const geometry::Facet& facet : part.hull().facets) {
    std::optional<StablePose> pose = RestOn(part, facet, least_tilt);
    if (!pose) continue;
    pose->label = fmt::format("{}P{}", part.initial(), poses.size() + 1);
    poses.push_back(*std::move(pose));
  }
  return poses;
}

}  // namespace assay::domain
