#include "sim/cli/effective_clearance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/mujoco/contact.h"

namespace assay::cli {
namespace {

using domain::Mating;
using geometry::Pose;
using geometry::Vector3;

constexpr double kReach = 4;          // nominal clearances that are searched
constexpr double kResolution = 1e-7;  // metres

// The frame of the hole in the world when the fixed part is where it starts; none if nothing of
// the mating goes into a hole.
std::optional<Pose> HoleFrame(const domain::Problem& problem, const Mating& mating) {
  const domain::Part& held = problem.part(mating.held);
  const domain::Part& fixed = problem.part(mating.fixed);
  for (const auto& [of_held, of_fixed] : mating.features) {
    const domain::Feature* const a = held.model->FindFeature(of_held);
    const domain::Feature* const b = fixed.model->FindFeature(of_fixed);
    if (a->mouths.empty() && !b->mouths.empty()) return fixed.X_WorldPart * b->X_PartFeature;
    if (!a->mouths.empty() && b->mouths.empty()) {
      return fixed.X_WorldPart * mating.X_FixedHeld * a->X_PartFeature;
    }
  }
  return {};
}

class ClearanceProbe {
 public:
  ClearanceProbe(const domain::Problem& problem, const scene::Scene& scene, const Mating& mating)
      : scene_(scene), mating_(mating), data_(scene.Start()) {
    const Pose& X_WorldFixed = problem.part(mating.fixed).X_WorldPart;
    X_WorldHeld_ = X_WorldFixed * mating.X_FixedHeld;
    X_WorldHeld_.translation() -=
        kDrawnBack * (X_WorldFixed.linear() * mating.mating_vector).normalized();
    scene_.SetPart(data_, mating.fixed, X_WorldFixed);
  }

  // The distance along the unit vector (world) at which the parts begin to touch, up to `most`.
  double Gap(const Vector3& direction, double most) {
    if (Touches(Vector3::Zero())) return 0;
    if (!Touches(most * direction)) return most;
    double free = 0, touching = most;
    while (touching - free > kResolution) {
      const double middle = (free + touching) / 2;
      (Touches(middle * direction) ? touching : free) = middle;
    }
    return free;
  }

 private:
  bool Touches(const Vector3& displacement) {
    Pose X_WorldHeld = X_WorldHeld_;
    X_WorldHeld.translation() += displacement;
    scene_.SetPart(data_, mating_.held, X_WorldHeld);
    data_.Forward();
    return scene_.Touching(data_, mating_.held, scene_.Body(mating_.fixed));
  }

  const scene::Scene& scene_;
  const Mating& mating_;
  mujoco::Data data_;
  Pose X_WorldHeld_;
};

}  // namespace

std::vector<EffectiveClearance> MeasureClearances(const domain::Problem& problem,
                                                  const scene::Scene& scene) {
  std::vector<EffectiveClearance> clearances;
  for (std::size_t m = 0; m < problem.matings.size(); ++m) {
    const std::optional<Pose> X_WorldHole = HoleFrame(problem, problem.matings[m]);
    if (!X_WorldHole) continue;
    EffectiveClearance clearance{domain::MatingId(m), problem.clearance, {}, 0};
    ClearanceProbe probe(problem, scene, problem.matings[m]);
    const Vector3 x = X_WorldHole->linear().col(0), y = X_WorldHole->linear().col(1);
    for (const Vector3& direction : {x, Vector3(-x), y, Vector3(-y)}) {
      const double gap = probe.Gap(direction, kReach * problem.clearance);
      clearance.gaps.push_back(gap);
      clearance.worst_deviation = std::max(clearance.worst_deviation,
                                           std::abs(gap - problem.clearance) / problem.clearance);
    }
    clearances.push_back(std::move(clearance));
  }
  return clearances;
}

}  // namespace assay::cli
