#include "planner/domain/grasps/shaft_end.h"

#include <algorithm>
#include <limits>

#include "planner/domain/grasps/pad_region.h"

namespace assay::domain {
namespace {

constexpr double kInPlane = 0.999;  // least cosine between a shaft's axis and the middle plane
constexpr double kLeastWay = 1e-3;  // metres; a shorter way frees too little of a shaft

double FarthestOf(const geometry::Polygon& polygon, const Vector2& direction) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vector2& p : polygon) farthest = std::max(farthest, direction.dot(p));
  return farthest;
}

}  // namespace

std::vector<Vector2> AwayFromTips(const PartModel& part, const FacePair& pair) {
  std::vector<Vector2> directions;
  for (const Feature& feature : part.features()) {
    const bool is_shaft = feature.mouths.empty() && !feature.is_plain_face();
    const auto has = [&](FaceId face) { return std::ranges::count(feature.faces, face) > 0; };
    if (!is_shaft || !has(pair.first) || !has(pair.second)) continue;
    const Vector2 away =
        -(pair.X_PartMiddle.linear().transpose() * feature.X_PartFeature.linear().col(2)).head<2>();
    if (away.norm() > kInPlane) directions.push_back(away.normalized());
  }
  return directions;
}

std::optional<Vector2> TowardsEnd(const geometry::Polygon& outline, const geometry::Polygon& pad,
                                  const Vector2& center, const Vector2& away) {
  const double way = FarthestOf(outline, away) - kDeepEnough - FarthestOf(pad, away);
  if (way < kLeastWay) return std::nullopt;
  return center + way * away;
}

}  // namespace assay::domain
