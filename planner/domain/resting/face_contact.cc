#include "planner/domain/resting/face_contact.h"

#include <algorithm>
#include <cmath>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/polygon.h"

namespace assay::domain {
namespace {

using geometry::Polygon;
using geometry::Vector2;
using geometry::Vector3;

constexpr double kInContact = 1e-5;        // metres between faces that touch
constexpr double kInLowestLayer = 1e-6;    // metres above the lowest vertex of a part that rests
constexpr double kFlatOnEachOther = 1e-6;  // difference of the cosine between the normals from -1
constexpr double kLooksDown = -0.5;  // greatest vertical component of a normal that looks down

// Adds the areas where a face of the upper part lies on a face of the lower part, in the lower
// part's frame.
void AddAreas(const Face& upper, const Pose& X_LowerUpper, const Face& lower,
              std::vector<std::vector<Vector3>>& areas) {
  const Vector3 normal = X_LowerUpper.linear() * upper.normal;
  if (lower.normal.dot(normal) > -1 + kFlatOnEachOther) return;
  const Vector3 on_upper = X_LowerUpper * (upper.offset * upper.normal);
  if (std::abs(lower.normal.dot(on_upper) - lower.offset) > kInContact) return;
  const Pose X_LowerFaceUpperFace = lower.X_PartFace.inverse() * X_LowerUpper * upper.X_PartFace;
  for (const Polygon& patch : upper.patches) {
    std::vector<Vector2> seen;
    for (const Vector2& p : patch) {
      seen.push_back((X_LowerFaceUpperFace * Vector3(p.x(), p.y(), 0)).head<2>());
    }
    for (const Polygon& other : lower.patches) {
      std::vector<Vector3> corners;
      for (const Vector2& p : geometry::Intersection(geometry::Hull2(seen), other)) {
        corners.push_back(lower.X_PartFace * Vector3(p.x(), p.y(), 0));
      }
      if (!corners.empty()) areas.push_back(std::move(corners));
    }
  }
}

}  // namespace

std::vector<Vector3> CornersOnTable(const PartModel& part, const Pose& X_WorldPart) {
  std::vector<Vector3> vertices;
  for (const Vector3& v : part.corners()) vertices.push_back(X_WorldPart * v);
  const auto height = [](const Vector3& v) { return v.z(); };
  const double lowest = height(*std::ranges::min_element(vertices, {}, height));
  if (std::abs(lowest) > kInContact) return {};
  std::erase_if(vertices, [&](const Vector3& v) { return v.z() > lowest + kInLowestLayer; });
  return vertices;
}

std::vector<std::vector<Vector3>> AreasOfContact(const PartModel& upper, const Pose& X_WorldUpper,
                                                 const PartModel& lower, const Pose& X_WorldLower) {
  std::vector<std::vector<Vector3>> areas;
  for (const Face& face : upper.faces()) {
    if ((X_WorldUpper.linear() * face.normal).z() > kLooksDown) continue;
    for (const Face& other : lower.faces()) {
      AddAreas(face, X_WorldLower.inverse() * X_WorldUpper, other, areas);
    }
  }
  for (std::vector<Vector3>& area : areas) {
    for (Vector3& corner : area) corner = X_WorldLower * corner;
  }
  return areas;
}

std::vector<Vector3> CornersOfContact(const PartModel& upper, const Pose& X_WorldUpper,
                                      const PartModel& lower, const Pose& X_WorldLower) {
  std::vector<Vector3> corners;
  for (const std::vector<Vector3>& area :
       AreasOfContact(upper, X_WorldUpper, lower, X_WorldLower)) {
    corners.insert(corners.end(), area.begin(), area.end());
  }
  return corners;
}

}  // namespace assay::domain
