#include "planner/uncertainty/preconditions/derivation.h"

#include <array>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/uncertainty/error_sets/mating_end.h"
#include "planner/uncertainty/error_sets/release.h"
#include "planner/uncertainty/standing/dragging.h"

namespace assay::uncertainty {
namespace {

using plan::NeededBy;
using plan::Origin;

std::vector<Precondition> Grasping(const HandWork& work) {
  return GraspPreconditions(work.world, work.part, work.hold, work.draw, work.held);
}

std::vector<Precondition> HandAtGrasp(const HandWork& work) {
  return HandClearanceAtGrasp(work.world, work.part, work.hold, work.draw, work.held,
                              work.action.kind->leaves == domain::Leaves::kWhereItWas);
}

std::vector<Precondition> ClosingPads(const HandWork& work) {
  return ClosingPreconditions(work.world, work.part, work.hold, work.draw, work.held);
}

std::vector<Precondition> HoldingPart(const HandWork& work) {
  const bool is_lifted = work.action.kind->leaves == domain::Leaves::kInHand;
  return HoldingPreconditions(work.world, work.part, work.hold, work.held,
                              is_lifted ? Turning::kNone : Turning::kAny);
}

std::vector<Precondition> Landing(const HandWork& work) {
  return LandingPreconditions(work.world, work.part, work.hold, work.X_ToolGrasp, work.X_WorldPart,
                              work.table, work.released);
}

std::vector<Precondition> MatingParts(const HandWork& work) {
  return MatingPreconditions(work.world, work.action.mating, work.hold, work.X_ToolGrasp);
}

std::vector<Precondition> TipAtStart(const HandWork& work) {
  return TipPreconditions(work.world, work.action.mating, work.hold, work.X_ToolGrasp,
                          *work.strategy);
}

std::vector<Precondition> HandAtRelease(const HandWork& work) {
  const domain::MatingId mating = work.action.mating;
  if (mating.IsNone()) {
    return HandClearanceAtPutdown(work.world, {work.part, work.hold, work.draw, work.X_WorldPart,
                                               -Vector3::UnitZ(), work.farther, work.released});
  }
  const MatingEnd end = MatingEndOf(work.world, mating, work.hold, work.X_ToolGrasp);
  return HandClearanceAtMating(
      work.world, mating,
      {work.part, work.hold, work.draw, work.X_WorldPart, end.motion, end.farther, work.released},
      work.strategy != nullptr);
}

std::vector<Precondition> PassingParts(const HandWork& work) {
  return PassingPreconditions(work.world, work.action, work.X_ToolGrasp, work.strategy);
}

// A part that a strategy led into its seat may lean within the play there.
std::vector<Precondition> StandingPart(const HandWork& work) {
  const domain::Problem& problem = work.world.problem();
  const domain::MatingId mating = work.action.mating;
  const bool is_led = !mating.IsNone() && work.strategy != nullptr;
  const double play =
      is_led ? PlayInSeat(problem, problem.mating(mating), problem.tolerances.clearance).turn : 0;
  return StandingPreconditions(work.world, work.part, work.hold, work.draw, work.X_WorldPart,
                               work.released, play);
}

std::vector<Precondition> FixedPart(const HandWork& work) {
  return FixedPreconditions(work.world, work.action.mating, work.hold, work.draw, work.released,
                            work.strategy);
}

std::vector<Precondition> PlaceOfMated(const HandWork& work) {
  const domain::MatingId mating = work.action.mating;
  const bool is_led = work.strategy != nullptr;
  return PlacePreconditions(
      work.world, mating, work.released,
      is_led ? Drag{} : DragOfFixed(work.world, mating, work.hold, work.draw));
}

constexpr auto kDerivations =
    std::to_array<Derivation>({{NeededBy::kGrasp, Origin::kPaper, false, Grasping},
                               {NeededBy::kPutdown, Origin::kPaper, true, Landing},
                               {NeededBy::kMating, Origin::kPaper, false, MatingParts},
                               {NeededBy::kStrategy, Origin::kPaper, false, TipAtStart},
                               {NeededBy::kGrasp, Origin::kSoundMode, false, HandAtGrasp},
                               {NeededBy::kGrasp, Origin::kSoundMode, false, ClosingPads},
                               {NeededBy::kCarrying, Origin::kSoundMode, false, HoldingPart},
                               {NeededBy::kRelease, Origin::kSoundMode, true, HandAtRelease},
                               {NeededBy::kMating, Origin::kSoundMode, true, PassingParts},
                               {NeededBy::kRelease, Origin::kSoundMode, true, StandingPart},
                               {NeededBy::kMating, Origin::kSoundMode, true, FixedPart},
                               {NeededBy::kMating, Origin::kSoundMode, true, PlaceOfMated}});

}  // namespace

std::span<const Derivation> Theory::KnownDerivations() { return kDerivations; }

}  // namespace assay::uncertainty
