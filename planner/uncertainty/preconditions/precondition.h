#pragma once

#include <string>
#include <vector>

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// An uncertainty-reduction precondition: expression < limit, or expression > limit, for all values
// of its variables.
struct Precondition {
  std::string condition;  // name, such as "between fingers"
  std::string meaning;    // text for people, such as "contact 1 lies on the inner side of finger 1"
  Expression expression;  // metres, radians, or a ratio
  plan::Relation relation = plan::Relation::kLess;
  double limit = 0;
  // The part from which the action keeps clear, if it does not handle that part.
  PartId neighbour = PartId::None();
};

// The ratio of a load to the bearable load if nothing bears the load. It stands for infinity.
inline constexpr double kNothingBorne = 1e6;

// The preconditions of one action. Equal claims about the same expression are kept once.
class Preconditions {
 public:
  void Less(std::string condition, std::string meaning, const Expression& expression, double limit,
            PartId neighbour = PartId::None());
  void Greater(std::string condition, std::string meaning, const Expression& expression,
               double limit, PartId neighbour = PartId::None());
  // Requires -limit < expression < limit.
  void Within(const std::string& condition, const std::string& meaning,
              const Expression& expression, double limit);

  std::vector<Precondition> Take() { return std::move(preconditions_); }

 private:
  void Add(Precondition precondition);

  std::vector<Precondition> preconditions_;
};

// Returns the preconditions of pickup and of squeezing. The part rests where the world has it, and
// `held` is the error that closing the pads will leave (ClosePads).
//   between fingers  Spar's four ("Derivation of Uncertainty-Reduction Goals"): 0 < y(P1^-1 C1),
//                    y(P1^-1 C2) and y(P2^-1 C1), y(P2^-1 C2) < 0, where P1 and P2 are the possible
//                    frames of the fingers, C1 and C2 the possible contacts
// Sound mode adds:
//   finger clear     no finger comes down on the part: the inner corners of the open fingers' pads
//                    lie outside the planes of the faces that they are to close on
//   fingertip        the fingers end above the table
//   pad contact      the grasped point stays inside the pads, by the workcell's margin
std::vector<Precondition> GraspPreconditions(const UncertainWorld& world, PartId part,
                                             const plan::Hold& hold, const ManipulatorError& draw,
                                             const HeldError& held);

// Returns the preconditions of putdown. The part in the hand comes to X_WorldPart, and `table` is
// the table's height error there.
//   landing height   every vertex that is to touch the table does so within the guarded travel
//   footprint        every such vertex lies on the table
//   neighbour clear  a line keeps the part's footprint and each neighbour's apart
// footprint and neighbour clear hold where the hand brings the part. If the part does not come
// upright, they also hold once it has settled, with the error `released` (Release).
std::vector<Precondition> LandingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const Transform& X_ToolGrasp,
                                               const Pose& X_WorldPart, const Expression& table,
                                               const RestingError& released);

// Returns the preconditions of assemble. For every shaft in its hole:
//   entry     the tip's vertices lie inside the planes of the hole's walls, with the bevelled edges
//   slide-in  without the bevels, the shaft's vertices lie inside these planes at the start and at
//             the end of the mating motion, and at the seat
//   tilt      the shaft leans in the hole by less than the angles of two-point contact and of
//             wedging (Whitney 1982: clearance / depth, clearance / (friction * width))
// For the mating as a whole:
//   seat      the motion ends within the guarded travel of the seat
// The wrist yields by the workcell's lateral compliance across each pair of walls that face each
// other. The shaft may stand out beyond one wall of a pair by as much, but it is no narrower for
// that.
std::vector<Precondition> MatingPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                              const plan::Hold& hold, const Transform& X_ToolGrasp);

// Returns the preconditions of assemble by a strategy, which replace entry, slide-in, tilt and
// seat:
//   tip shift, tip turn   the tip's error (tip_error.h) is one that the strategy absorbs
std::vector<Precondition> TipPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                           const plan::Hold& hold, const Transform& X_ToolGrasp,
                                           const plan::Strategy& strategy);

// Returns the precondition of holding, for every action with a part in the hand, in sound mode:
//   holding          the ratio of the load on the pads to what they bear is below 1. The load is
//                    weight, accelerations (planner/plan/data/carrying.h) and the lever from the
//                    pads to the centre of mass. The pads bear it by the least friction within its
//                    tolerance (pad_friction.h), under the grip force
enum class Turning {
  kNone,  // lifted, with the orientation in which it was taken
  kAny,   // carried, with any lean of the hand on its way
};
std::vector<Precondition> HoldingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const HeldError& held,
                                               Turning turning);

// Returns the preconditions of closing the pads, for pickup and squeezing in sound mode. `held` is
// the error that closing the pads will leave.
//   upright          the part slides before a pad and does not topple: the moment of the push about
//                    every edge that it stands on, over that of its weight, is below 1
//   pushed clear     the part is pushed into no neighbour
std::vector<Precondition> ClosingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held);

// Returns the preconditions of a part that is let go, for putdown and assemble in sound mode. The
// part in the hand comes to X_WorldPart, and will then have the error `released`; it leans by at
// most `play` radians in addition to its lean in the hand.
//   standing         once let go, the part falls back on what it stands on, however it leans: a
//                    ratio below 1
//   pressed          pads that slide down on the part do not press it over an edge of what it
//                    stands on: a ratio below 1
//   fingertip        the fingers stay above the table and beside what the part stands on
std::vector<Precondition> StandingPreconditions(const UncertainWorld& world, PartId part,
                                                const plan::Hold& hold,
                                                const ManipulatorError& draw,
                                                const Pose& X_WorldPart,
                                                const RestingError& released, double play);

// Returns the preconditions of the fixed part, for assemble in sound mode. Both are ratios below 1:
//   fixed stands     the push of the mating, wherever the parts touch, tips neither the fixed part
//                    nor the parts under it
//   fixed stays      the push of the mating does not move the fixed part aside
std::vector<Precondition> FixedPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                             const RestingError& released,
                                             const plan::Strategy* strategy);

// The work of a hand that lets a part go, in a putdown or a mating.
struct LettingGo {
  PartId part;
  const plan::Hold& hold;
  const ManipulatorError& draw;
  Pose X_WorldPart;    // pose at which the part is let go
  Vector3 motion;      // unit vector of the motion that brings it there, world
  Expression farther;  // metres along the motion to where the part meets what it is let go on
  const RestingError& released;  // its error once it is let go
};

// Return the precondition of the hand, for every action with the hand in sound mode:
//   hand clear       a plane keeps each piece of hand and fingers apart from every part, on the
//                    straight way to where the pads close or open, and on the way from there
// The part between the pads is tested where it rests before it is taken, and where it is in the
// hand. Its pieces behind the planes in which the closing pads are to touch it are left out. The
// fixed part of a mating, and parts beside it, are tested on the hand's way in, too.
std::vector<Precondition> HandClearanceAtGrasp(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held, bool opens_again);
std::vector<Precondition> HandClearanceAtPutdown(const UncertainWorld& world,
                                                 const LettingGo& work);
// `is_led` is set if a strategy leads the part: the hand yields to it.
std::vector<Precondition> HandClearanceAtMating(const UncertainWorld& world,
                                                domain::MatingId mating, const LettingGo& work,
                                                bool is_led);

// Returns the precondition of the held part's way, for assemble in sound mode. `strategy` is null
// if the motion goes straight to the seat; otherwise the motion goes to where the strategy starts.
//   passing clear    a plane keeps each piece of the held part, all along the mating motion, apart
//                    from each piece of every other part. Left out are shafts in their holes, and
//                    pieces of the fixed part that lie ahead even at the seat
std::vector<Precondition> PassingPreconditions(const UncertainWorld& world,
                                               const plan::Action& assemble,
                                               const Transform& X_ToolGrasp,
                                               const plan::Strategy* strategy);

}  // namespace assay::uncertainty
