#include "planner/domain/resting/face_contact.h"

#include <algorithm>
#include <cmath>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/round_solid.h"

namespace assay::domain {
namespace {

using geometry::Polygon;
using geometry::Vector2;
using geometry::Vector3;

constexpr double kInContact = 1e-5;        // metres between faces that touch
constexpr double kInLowestLayer = 1e-6;    // metres above the lowest vertex of a part that rests
constexpr double kFlatOnEachOther = 1e-6;  // difference of the cosine between the normals from -1
constexpr double kLooksDown = -0.5;  // greatest vertical component of a normal that looks down

// Returns the areas where a face of the upper part lies on a face of the lower part, in the lower
// part's frame.
std::vector<std::vector<Vector3>> AreasOf(const Face& upper, const Pose& X_LowerUpper,
                                          const Face& lower) {
  const Vector3 normal = X_LowerUpper.linear() * upper.normal;
  if (lower.normal.dot(normal) > -1 + kFlatOnEachOther) return {};
  const Vector3 on_upper = X_LowerUpper * (upper.offset * upper.normal);
  if (std::abs(lower.normal.dot(on_upper) - lower.offset) > kInContact) return {};
  std::vector<std::vector<Vector3>> areas;
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
  return areas;
}

}  // namespace

Vector3 TrueTouch(const PartModel& part, const Vector3& corner, const Vector3& normal) {
  for (const geometry::RoundSolid& round : part.round_solids()) {
    if (const auto touch = geometry::TouchInPlaceOf(corner, round, normal)) return *touch;
  }
  return corner;
}

std::vector<Vector3> CornersOnTable(const PartModel& part, const Pose& X_WorldPart) {
  const auto height = [&](const Vector3& corner) { return (X_WorldPart * corner).z(); };
  const double lowest = height(*std::ranges::min_element(part.corners(), {}, height));
  if (std::abs(lowest) > kInContact) return {};
  const Vector3 down = -X_WorldPart.linear().row(2).transpose();
  std::vector<Vector3> touches;
  for (const Vector3& corner : part.corners()) {
    if (height(corner) > lowest + kInLowestLayer) continue;
    touches.push_back(X_WorldPart * TrueTouch(part, corner, down));
  }
  return touches;
}

std::vector<std::vector<Vector3>> AreasOfContact(const PartModel& upper, const Pose& X_WorldUpper,
                                                 const PartModel& lower, const Pose& X_WorldLower) {
  std::vector<std::vector<Vector3>> areas;
  const Pose X_LowerUpper = X_WorldLower.inverse() * X_WorldUpper;
  for (const Face& face : upper.faces()) {
    if ((X_WorldUpper.linear() * face.normal).z() > kLooksDown) continue;
    for (const Face& other : lower.faces()) {
      const auto touch = [&](const Vector3& corner) -> Vector3 {
        const Vector3 of_lower = TrueTouch(lower, corner, other.normal);
        return X_LowerUpper * TrueTouch(upper, X_LowerUpper.inverse() * of_lower, face.normal);
      };
      for (std::vector<Vector3>& area : AreasOf(face, X_LowerUpper, other)) {
        std::ranges::transform(area, area.begin(), touch);
        areas.push_back(std::move(area));
      }
    }
  }
  for (std::vector<Vector3>& area : areas) {
    for (Vector3& corner : area) corner = X_WorldLower * corner;
  }
  return areas;
}

std::vector<std::vector<Vector3>> FacesInContact(const PartModel& upper, const Pose& X_WorldUpper,
                                                 const PartModel& lower, const Pose& X_WorldLower) {
  std::vector<std::vector<Vector3>> patches;
  const Pose X_LowerUpper = X_WorldLower.inverse() * X_WorldUpper;
  for (const Face& other : lower.faces()) {
    const bool touches = std::ranges::any_of(upper.faces(), [&](const Face& face) {
      return (X_WorldUpper.linear() * face.normal).z() <= kLooksDown &&
             !AreasOf(face, X_LowerUpper, other).empty();
    });
    if (!touches) continue;
    for (const Polygon& patch : other.patches) {
      std::vector<Vector3>& corners = patches.emplace_back();
      for (const Vector2& p : patch)
        corners.push_back(X_WorldLower * other.X_PartFace * Vector3(p.x(), p.y(), 0));
    }
  }
  return patches;
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
