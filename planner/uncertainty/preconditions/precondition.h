#pragma once

#include <string>
#include <vector>

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// An uncertainty-reduction precondition: expression < limit, or >, for all values of its variables.
struct Precondition {
  std::string condition;  // which: "between fingers"
  std::string meaning;    // for people: "contact 1 lies on the inner side of finger 1"
  Expression expression;  // metres, radians, or a ratio
  plan::Relation relation = plan::Relation::kLess;
  double limit = 0;
  PartId neighbour = PartId::None();  // that it keeps clear of, and that the action does not handle
};

// The ratio of a load to what bears it, where nothing does.
inline constexpr double kNothingBorne = 1e6;

// The preconditions of one action. Those that say the same of the same expression are kept once.
class Preconditions {
 public:
  void Less(std::string condition, std::string meaning, const Expression& expression, double limit,
            PartId neighbour = PartId::None());
  void Greater(std::string condition, std::string meaning, const Expression& expression,
               double limit, PartId neighbour = PartId::None());
  // -limit < expression < limit.
  void Within(const std::string& condition, const std::string& meaning,
              const Expression& expression, double limit);

  std::vector<Precondition> Take() { return std::move(preconditions_); }

 private:
  void Add(Precondition precondition);

  std::vector<Precondition> preconditions_;
};

// Of pickup, and of squeezing: the part rests where the world says.
//   between fingers  Spar's four ("Derivation of Uncertainty-Reduction Goals"):
//                    0 < y(P1^-1 C1), y(P1^-1 C2) and y(P2^-1 C1), y(P2^-1 C2) < 0, where P1 and P2
//                    are the possible frames of the fingers, C1 and C2 the possible contacts
// and in sound mode:
//   finger clear     no finger comes down on the part: the inner corners of the open fingers' pads
//                    lie outside the planes of the faces that they are to close on
//   fingertip        the fingers end above the table
//   pad contact      the grasped point stays inside the pads, by the workcell's margin
// `held` is what closing the pads will leave (ClosePads).
std::vector<Precondition> GraspPreconditions(const UncertainWorld& world, PartId part,
                                             const plan::Hold& hold, const ManipulatorError& draw,
                                             const HeldError& held);

// Of putdown: the part in the hand comes to X_WorldPart; `table` is the table's height error there.
//   landing height   every vertex that is to touch the table does so within the guarded travel
//   footprint        and lies on the table
//   neighbour clear  a line keeps the part's footprint and each neighbour's apart
// the last two as the hand brings the part and, if it does not come upright, as it settles: with
// the error `released` (Release).
std::vector<Precondition> LandingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const Transform& X_ToolGrasp,
                                               const Pose& X_WorldPart, const Expression& table,
                                               const RestingError& released);

// Of assemble: for every shaft in its hole,
//   entry     the tip's vertices lie inside the planes of the hole's walls, bevelled edges counted
//   slide-in  the same at the start and at the end of the mating motion, at the seat, without the
//             bevels
//   tilt      the shaft leans in the hole by less than two-point contact and wedging need (Whitney
//             1982: clearance / depth, clearance / (friction * width))
// and
//   seat      the motion ends within the guarded travel of the seat.
// The wrist yields by the workcell's lateral compliance across each pair of walls that face each
// other: the shaft may stand out beyond one of them by as much, but it is no narrower for that.
std::vector<Precondition> MatingPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                              const plan::Hold& hold, const Transform& X_ToolGrasp);

// Of assemble by a strategy, instead of entry, slide-in, tilt and seat:
//   tip shift, tip turn   the tip's error (tip_error.h) is one that the strategy absorbs
std::vector<Precondition> TipPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                           const plan::Hold& hold, const Transform& X_ToolGrasp,
                                           const plan::Strategy& strategy);

// Of every action with a part in the hand, in sound mode:
//   holding          the load on the pads over what they bear is below 1: their friction
//                    (pad_friction.h), the least within its tolerance, under the grip force against
//                    weight, accelerations (planner/plan/data/carrying.h) and the lever from the
//                    pads to the centre of mass
enum class Turning {
  kNone,  // as where it was taken: lifted
  kAny,   // however the hand may lean on its way
};
std::vector<Precondition> HoldingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const HeldError& held,
                                               Turning turning);

// Of pickup and of squeezing, in sound mode: `held` is what closing the pads will leave.
//   upright          the part slides before a pad and does not topple: the moment of the push about
//                    every edge that it stands on, over that of its weight, is below 1
//   pushed clear     and it is pushed into no neighbour
std::vector<Precondition> ClosingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held);

// Of putdown and assemble, in sound mode: the part in the hand comes to X_WorldPart, and will then
// have the error `released`, and lean by at most `play` radians besides what it leans in the hand.
//   standing         let go, it falls back on what it stands on, however it leans
//   pressed          pads that slide down on it do not press it over an edge of that
// both ratios below 1; and
//   fingertip        the fingers stay above the table and beside what the part stands on
std::vector<Precondition> StandingPreconditions(const UncertainWorld& world, PartId part,
                                                const plan::Hold& hold,
                                                const ManipulatorError& draw,
                                                const Pose& X_WorldPart,
                                                const RestingError& released, double play);

// Of assemble, in sound mode:
//   fixed stands     the push of the mating, wherever the parts touch, tips neither the fixed part
//                    nor what that stands on
//   fixed stays      nor does it push the fixed part aside
// both ratios below 1.
std::vector<Precondition> FixedPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                             const RestingError& released,
                                             const plan::Strategy* strategy);

// What is let go in a putdown or a mating.
struct LettingGo {
  PartId part;
  const plan::Hold& hold;
  const ManipulatorError& draw;
  Pose X_WorldPart;              // where it is let go
  Vector3 motion;                // that brings it there: unit, world
  Expression farther;            // metres along the motion until it meets what it is let go on
  const RestingError& released;  // its error then
};

// Of every action with the hand, in sound mode:
//   hand clear       a plane keeps each piece of hand and fingers, on the straight way to where the
//                    pads close or open and from there, and every part apart. Of the part between
//                    the pads: but for what is behind the planes in which they are to touch it,
//                    once they close; as it rests before it is taken, and as it is in the hand. Of
//                    the fixed part of a mating, and what is beside it: also on the way in.
std::vector<Precondition> HandClearanceAtGrasp(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held, bool opens_again);
std::vector<Precondition> HandClearanceAtPutdown(const UncertainWorld& world,
                                                 const LettingGo& work);
// `is_led`: by a strategy, to which the hand yields.
std::vector<Precondition> HandClearanceAtMating(const UncertainWorld& world,
                                                domain::MatingId mating, const LettingGo& work,
                                                bool is_led);

// Of assemble, in sound mode:
//   passing clear    a plane keeps each piece of the held part, all along the mating motion, and
//                    each piece of every other part apart; but for shafts in their holes, and for
//                    what of the fixed part lies ahead even at the seat. `strategy`: null if the
//                    motion goes straight to the seat; else it goes to where the strategy starts
std::vector<Precondition> PassingPreconditions(const UncertainWorld& world,
                                               const plan::Assemble& assemble,
                                               const Transform& X_ToolGrasp,
                                               const plan::Strategy* strategy);

}  // namespace assay::uncertainty
