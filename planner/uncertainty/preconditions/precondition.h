#pragma once

#include <string>
#include <vector>

#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

struct Drag;  // planner/uncertainty/standing/dragging.h

// An uncertainty-reduction precondition: expression < limit, or expression > limit, for all values
// of its variables.
struct Precondition {
  plan::Condition condition;
  std::string meaning;    // text for people, such as "contact 1 lies on the inner side of finger 1"
  Expression expression;  // in SI units of the condition's dimension
  plan::Relation relation = plan::Relation::kLess;
  double limit = 0;
  // The part from which the action keeps clear, if it does not handle that part.
  PartId neighbour = PartId::None();
  plan::Circumstance circumstance = plan::Circumstance::kUsual;
};

using plan::kNothingBorne;

// The preconditions of one action. Equal claims about the same expression are kept once.
class Preconditions {
 public:
  void Less(plan::Condition condition, std::string meaning, const Expression& expression,
            double limit, PartId neighbour = PartId::None());
  void Greater(plan::Condition condition, std::string meaning, const Expression& expression,
               double limit, PartId neighbour = PartId::None());
  // Requires -limit < expression < limit.
  void Within(plan::Condition condition, const std::string& meaning, const Expression& expression,
              double limit);

  void Add(Precondition precondition);

  std::vector<Precondition> Take() { return std::move(preconditions_); }

 private:
  std::vector<Precondition> preconditions_;
};

// The functions below derive preconditions. condition_table.h says what each kind means. Kinds
// that the paper does not ask for are derived in sound mode only.

// Return the preconditions of pickup and of squeezing: kBetweenFingers, kFingerClear, kFingertip
// and kPadContact; and kUpright and kPushedClear. The part rests where the world has it, and `held`
// is the error that closing the pads will leave (ClosePads).
std::vector<Precondition> GraspPreconditions(const UncertainWorld& world, PartId part,
                                             const plan::Hold& hold, const ManipulatorError& draw,
                                             const HeldError& held);
std::vector<Precondition> ClosingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held);

// Returns the preconditions of putdown: kLandingHeight, kFootprint and kNeighbourClear. The part in
// the hand comes to X_WorldPart, and `table` is the table's height error there. If the part does
// not come upright, it then settles with the error `released` (Release).
std::vector<Precondition> LandingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const Transform& X_ToolGrasp,
                                               const Pose& X_WorldPart, const Expression& table,
                                               const RestingError& released);

// Returns the preconditions of assemble: kEntry, kSlideIn and kTilt for every shaft in its hole,
// and kSeat for the mating as a whole.
std::vector<Precondition> MatingPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                              const plan::Hold& hold, const Transform& X_ToolGrasp);

// Returns the preconditions of assemble by a strategy: kTipShift and kTipTurn. They say that the
// tip's error (tip_error.h) is one that the strategy absorbs.
std::vector<Precondition> TipPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                           const plan::Hold& hold, const Transform& X_ToolGrasp,
                                           const plan::Strategy& strategy);

// Returns kHolding, for every action with a part in the hand.
enum class Turning {
  kNone,  // lifted, with the orientation in which it was taken
  kAny,   // carried, with any lean of the hand on its way
};
std::vector<Precondition> HoldingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const HeldError& held,
                                               Turning turning);

// Returns the preconditions of a part that is let go, for putdown and assemble: kStanding, kPressed
// and kFingertip. The part in the hand comes to X_WorldPart, and will then have the error
// `released`; it leans by at most `play` radians in addition to its lean in the hand.
std::vector<Precondition> StandingPreconditions(const UncertainWorld& world, PartId part,
                                                const plan::Hold& hold,
                                                const ManipulatorError& draw,
                                                const Pose& X_WorldPart,
                                                const RestingError& released, double play);

// Returns the preconditions of the fixed part, for assemble: kFixedStands and kFixedStays.
std::vector<Precondition> FixedPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                             const plan::Hold& hold, const ManipulatorError& draw,
                                             const RestingError& released,
                                             const plan::Strategy* strategy);

// Returns kInPlace, for assemble. The held part ends with the error `released`, and the mating
// drags the fixed part by at most `drag`.
std::vector<Precondition> PlacePreconditions(const UncertainWorld& world, domain::MatingId mating,
                                             const RestingError& released, const Drag& drag);

// The work of a hand that lets a part go, in a putdown or a mating.
struct LettingGo {
  PartId part;
  const plan::Hold& hold;
  const ManipulatorError& draw;
  Pose X_WorldPart;              // pose at which the part is let go
  Vector3 motion;                // unit vector of the motion that brings it there, world
  Expression farther;            // metres along the motion until the part meets its support
  const RestingError& released;  // the part's error after it has been let go
};

// Return kHandClear, for every action with the hand.
std::vector<Precondition> HandClearanceAtGrasp(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held, bool opens_again);
std::vector<Precondition> HandClearanceAtPutdown(const UncertainWorld& world,
                                                 const LettingGo& work);
// `is_led` is set if a strategy leads the part: the hand yields to it.
std::vector<Precondition> HandClearanceAtMating(const UncertainWorld& world,
                                                domain::MatingId mating, const LettingGo& work,
                                                bool is_led);

// Returns kPassingClear, for assemble. `strategy` is null if the motion goes straight to the seat;
// otherwise the motion goes to where the strategy starts.
std::vector<Precondition> PassingPreconditions(const UncertainWorld& world,
                                               const plan::Action& assemble,
                                               const Transform& X_ToolGrasp,
                                               const plan::Strategy* strategy);

}  // namespace assay::uncertainty
