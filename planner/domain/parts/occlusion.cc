#include "planner/domain/parts/occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace assay::domain {
namespace {

using geometry::Polygon;

constexpr double kTouching = 0.001;                   // metres between faces that touch
constexpr double kParallel = std::numbers::pi / 180;  // radians between their planes

// Returns whether two faces have opposite normals and touch.
bool FaceEachOther(const Pose& X_WorldA, const Pose& X_WorldB) {
  const Vector3 n = X_WorldA.linear().col(2);
  const double gap = n.dot(X_WorldB.translation() - X_WorldA.translation());
  return -n.dot(X_WorldB.linear().col(2)) >= std::cos(kParallel) && std::abs(gap) <= kTouching;
}

// Returns a polygon on one face in the coordinates of the face that lies against it.
Polygon OntoFace(const Polygon& polygon, const Pose& X_FaceOther) {
  Polygon seen;
  for (const Vector2& corner : polygon) {
    seen.push_back((X_FaceOther * Vector3(corner.x(), corner.y(), 0)).head<2>());
  }
  std::ranges::reverse(seen);  // seen from the other side, the corners run the other way round
  return seen;
}

class Occlusion {
 public:
  Occlusion(const PartModel& model, const Pose& X_WorldPart)
      : model_(model), X_WorldPart_(X_WorldPart) {}

  // Records the features that a surface hides because it lies against the part. The surface
  // consists of polygons in the x-y plane of X_WorldFace. The normal of the surface is the z axis
  // of X_WorldFace.
  void Cover(const Pose& X_WorldFace, const std::vector<Polygon>& patches) {
    for (std::size_t f = 0; f < model_.faces().size(); ++f) {
      const Pose X_WorldOurs = X_WorldPart_ * model_.faces()[f].X_PartFace;
      if (!FaceEachOther(X_WorldOurs, X_WorldFace)) continue;
      for (const Polygon& patch : patches) {
        const auto under =
            model_.FeaturesUnder(FaceId(f), OntoFace(patch, X_WorldOurs.inverse() * X_WorldFace));
        hidden_.insert(under.begin(), under.end());
      }
    }
  }

  std::vector<FeatureNumber> Hidden() const { return {hidden_.begin(), hidden_.end()}; }

 private:
  const PartModel& model_;
  const Pose& X_WorldPart_;
  std::set<FeatureNumber> hidden_;
};

// Returns the stable pose that hides the same features as a part that rests on something other than
// the table (Spar, "Stable Poses and Position Classes"). Returns the first of several, and None if
// none does.
StablePoseId PoseThatHides(const PartModel& model, const std::vector<FeatureNumber>& features) {
  const auto found = std::ranges::find(model.stable_poses(), features, &StablePose::hidden);
  if (found == model.stable_poses().end()) return StablePoseId::None();
  return StablePoseId(static_cast<std::size_t>(found - model.stable_poses().begin()));
}

}  // namespace

std::vector<FeatureNumber> OccludedFeatures(const Problem& problem, PartId part,
                                            const Pose& X_WorldPart,
                                            std::span<const PlacedPart> others) {
  Occlusion occlusion(*problem.part(part).model, X_WorldPart);
  for (const Table& table : problem.workcell->tables()) {
    occlusion.Cover(Pose::Identity(), {table.top});
  }
  for (const PlacedPart& other : others) {
    if (other.part == part) continue;
    for (const Face& face : problem.part(other.part).model->faces()) {
      occlusion.Cover(other.X_WorldPart * face.X_PartFace, face.patches);
    }
  }
  return occlusion.Hidden();
}

void NoteOcclusions(Problem& problem) {
  std::vector<PlacedPart> placed;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    placed.push_back({.part = PartId(p), .X_WorldPart = problem.parts[p].X_WorldPart});
  }
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    Part& part = problem.parts[p];
    part.hidden = OccludedFeatures(problem, PartId(p), part.X_WorldPart, placed);
    part.position_class =
        part.resting.IsNone() ? PoseThatHides(*part.model, part.hidden) : part.resting;
  }
}

}  // namespace assay::domain
