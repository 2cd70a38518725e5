#include "planner/domain/parts/part_model.h"

#include <algorithm>
#include <utility>

#include "planner/domain/parts/part_shape.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {
namespace {

// A region touches a hole if it reaches at least this far into the hole's mouth or onto the hole's
// wall, in metres.
constexpr double kReached = 1e-7;

bool IsUnder(const Feature& feature, FaceId face, const geometry::Polygon& region) {
  const auto reaches = [&](const auto& part) {
    return part.face == face && geometry::Gap(part.outline, region) < -kReached;
  };
  return std::ranges::any_of(feature.mouths, reaches) ||
         std::ranges::any_of(feature.walls, reaches);
}

}  // namespace

PartShape::PartShape(std::vector<geometry::ConvexHull> solids,
                     std::vector<geometry::RoundSolid> round, double density)
    : pieces(std::move(solids)),
      collision(pieces),
      hull(geometry::HullOf(geometry::VerticesOf(pieces))),
      mass(geometry::MassOf(pieces, density)),
      round_solids(std::move(round)) {}

const std::vector<geometry::ConvexHull>& PartModel::pieces() const { return shape_->pieces; }
const geometry::CollisionShape& PartModel::shape() const { return shape_->collision; }
const geometry::ConvexHull& PartModel::hull() const { return shape_->hull; }
const std::vector<Vector3>& PartModel::corners() const { return shape_->hull.vertices; }
const geometry::MassProperties& PartModel::mass() const { return shape_->mass; }
const std::vector<geometry::RoundSolid>& PartModel::round_solids() const {
  return shape_->round_solids;
}

const Feature* PartModel::FindFeature(FeatureNumber number) const {
  const auto found = std::ranges::find(features_, number, &Feature::number);
  return found == features_.end() ? nullptr : &*found;
}

std::vector<FeatureNumber> PartModel::FeaturesUnder(FaceId face,
                                                    const geometry::Polygon& region) const {
  const bool touched = geometry::Meets(faces_[face.index()].patches, region);
  std::vector<FeatureNumber> numbers;
  for (const Feature& feature : features_) {
    const bool has_face = std::ranges::find(feature.faces, face) != feature.faces.end();
    if ((touched && has_face) || IsUnder(feature, face, region)) numbers.push_back(feature.number);
  }
  return numbers;
}

StablePoseId PartModel::FindStablePose(std::string_view name) const {
  const auto found = std::ranges::find(stable_poses_, name, &StablePose::name);
  if (name.empty() || found == stable_poses_.end()) return StablePoseId::None();
  return StablePoseId(static_cast<std::size_t>(found - stable_poses_.begin()));
}

}  // namespace assay::domain
