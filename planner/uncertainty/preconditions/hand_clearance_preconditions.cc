#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "planner/algebra/expression/simplify.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/error_sets/mating_end.h"
#include "planner/uncertainty/error_sets/release.h"
#include "planner/uncertainty/pads/touching_cells.h"
#include "planner/uncertainty/preconditions/clearance.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "planner/uncertainty/standing/dragging.h"

namespace assay::uncertainty {
namespace {

using geometry::Box;
using geometry::ConvexHull;

constexpr double kFlush = 1e-6;  // metres; bodies count as flush up to this distance

// Returns the box, along the frame's axes, that surrounds all these boxes.
Box Around(std::initializer_list<Box> boxes) {
  Eigen::AlignedBox3d bounds;
  for (const Box& box : boxes) {
    for (const Vector3& corner : box.Corners()) bounds.extend(corner);
  }
  return Box::FromCorners(bounds.min(), bounds.max());
}

// Boxes of the hand in the tool's frame, on its straight way to its work and from there.
struct Hand {
  std::vector<Box> palm;     // the palm, swept along its way back
  std::vector<Box> open;     // the open fingers, swept along their way back
  std::vector<Box> closing;  // the fingers, swept from open to closed
  std::vector<Box> swept;    // the fingers, swept along all their ways
  std::vector<Box> closed;   // the closed hand with its fingers

  Hand(const domain::Workcell& workcell, double width) {
    const kinematics::Gripper& gripper = workcell.gripper();
    const Pose back = geometry::Translation(0, 0, -workcell.rules().approach_distance);
    closed = gripper.HandBoxes();
    for (const Box& box : gripper.HandBoxes()) {
      palm.push_back(Around({box, box.Transformed(back)}));
    }
    const std::vector<Box> wide = gripper.FingerBoxes(gripper.max_opening());
    const std::vector<Box> narrow = gripper.FingerBoxes(width);
    for (std::size_t i = 0; i < wide.size(); ++i) {
      closed.push_back(narrow[i]);
      open.push_back(Around({wide[i], wide[i].Transformed(back)}));
      closing.push_back(Around({wide[i], narrow[i]}));
      swept.push_back(Around({open.back(), narrow[i], narrow[i].Transformed(back)}));
    }
  }
};

// Returns the grasp as seen from the true hand.
Transform GraspInHand(const HeldError& held) {
  return PossibleGrasp(held, {0, 0, 0, 0}, Propagation::kSound);
}

class HandConditions {
 public:
  enum class Leaves { kYes, kNo };

  // `tool` is the frame of the hand as its pads close or open, with unchanged believed poses.
  HandConditions(const UncertainWorld& world, PartId handled, const plan::Hold& hold,
                 const PossibleFrame& tool)
      : world_(world),
        handled_(handled),
        hold_(hold),
        hand_(*world.problem().workcell, hold.width),
        tool_(tool) {}

  // Requires clearance from all parts that rest except `but`. The hand's way does not depend on the
  // believed poses of these parts, but on a believed pose that has moved by `shift`. Some of these
  // parts may be dragged along.
  void RequireClearOfOthers(const std::vector<PartId>& but, const BelievedShift& shift,
                            const Vector3& way_in, const std::vector<Drag>& drags) {
    const PossibleFrame tool = Shifted(world_, tool_, shift);
    const std::vector<Body> bodies = Swept(tool, WayOf(world_, way_in, shift.turn));
    for (int p = 0; p < static_cast<int>(world_.problem().parts.size()); ++p) {
      const PartId other(p);
      if (std::ranges::count(but, other) > 0) continue;
      const double dragged = ReachOfDrag(world_.problem(), drags, other);
      RequireClear(tool, bodies, FrameOf(world_, other), other, other, Vector3::Constant(dragged));
    }
  }

  // Requires clearance from the fixed part, whose believed pose guides the hand in the insertion.
  void RequireClearOfFixed(PartId fixed, const Vector3& way_in, const Vector3& slack) {
    RequireClear(tool_, Swept(tool_, WayOf(world_, way_in, 0)), BelievedFrameOf(world_, fixed),
                 fixed, PartId::None(), slack);
  }

  // Requires clearance from the part between the pads, where it rests.
  void RequireClearOfTaken() {
    RequireClearOfHandled(tool_, BelievedFrameOf(world_, handled_), Vector3::Zero(), Leaves::kYes);
  }

  // Requires clearance from the part between the pads, where it is in the closed hand. `slack` is
  // in the world's axes. `leaves` says whether the open hand then goes away without the part.
  void RequireClearOfHeld(const HeldError& held, const Vector3& slack, Leaves leaves) {
    const Pose planned = hold_.X_PartTool.inverse();
    RequireClearOfHandled({Pose::Identity(), {}, 0},
                          {planned, algebra::Simplify(GraspInHand(held) * AsTransform(planned)),
                           OffInHandOf(world_, held).turn},
                          tool_.planned.linear().transpose().cwiseAbs() * slack, leaves);
  }

  std::vector<Precondition> Take() { return conditions_.Take(); }

 private:
  // Returns hand and fingers on all ways that they take where the step acts. The closed hand on the
  // way in is added, unless the hand leaves on the same way.
  std::vector<Body> Swept(const PossibleFrame& tool, const StraightWay& way_in) const {
    std::vector<Body> bodies;
    for (const auto* boxes : {&hand_.palm, &hand_.swept}) {
      for (const Box& box : *boxes) bodies.emplace_back(tool, HullOf(box));
    }
    const Vector3 in_tool = tool.planned.linear().transpose() * way_in.planned;
    const double approach = world_.problem().workcell->rules().approach_distance;
    if (in_tool.head<2>().norm() < kFlush && in_tool.z() <= 0 && in_tool.z() >= -approach) {
      return bodies;
    }
    for (const Box& box : hand_.closed) bodies.emplace_back(tool, HullOf(box), way_in);
    return bodies;
  }

  void RequireClear(const PossibleFrame& tool, const std::vector<Body>& bodies,
                    const PossibleFrame& frame, PartId part, PartId neighbour,
                    const Vector3& slack) {
    const Clearance clearance = {ClearOf(part), DisplacementBetween(world_, tool, frame), slack,
                                 neighbour};
    for (const ConvexHull& piece : world_.problem().part(part).model->pieces()) {
      const Body other(frame, piece);
      for (const Body& body : bodies) RequireApart(body, other, clearance, conditions_);
    }
  }

  void RequireClearOfHandled(const PossibleFrame& tool, const PossibleFrame& frame,
                             const Vector3& slack, Leaves leaves) {
    const Clearance clearance = {ClearOf(handled_), DisplacementBetween(world_, tool, frame),
                                 slack};
    std::vector<Body> passing;
    for (const Box& box : hand_.palm) passing.emplace_back(tool, HullOf(box));
    for (const Box& box : hand_.open) {
      if (leaves == Leaves::kYes) passing.emplace_back(tool, HullOf(box));
    }
    for (const ConvexHull& piece : world_.problem().part(handled_).model->pieces()) {
      const Body other(frame, piece);
      for (const Body& body : passing) RequireApart(body, other, clearance, conditions_);
      for (const Box& finger : hand_.closing) {
        if (LiesBehindPad(piece, finger)) continue;
        RequireApart(Body(tool, HullOf(finger)), other, clearance, conditions_);
      }
    }
  }

  // Returns whether a piece of the part is behind the plane in which a pad is to touch. A finger
  // that moves with this pad meets the piece where it is meant to, or not at all.
  bool LiesBehindPad(const ConvexHull& of_part, const Box& of_finger) const {
    const double side = of_finger.X_FrameBox.translation().y() > 0 ? 1 : -1;
    const Vector3 outward = side * hold_.X_PartTool.linear().col(1);
    return GreatestAlong(of_part, outward) - outward.dot(hold_.X_PartTool.translation()) <=
           hold_.width / 2 + kFlush;
  }

  Statement ClearOf(PartId part) const {
    return {plan::condition::kHandClear,
            fmt::format("the hand stays clear of {}", world_.problem().part(part).name)};
  }

  const UncertainWorld& world_;
  PartId handled_;
  const plan::Hold& hold_;
  Hand hand_;
  PossibleFrame tool_;
  Preconditions conditions_;
};

// Returns the greatest movement, along each axis in metres, of a part that is let go against the
// hand. The pads slide down on the part along the motion that brought the part, and the part falls
// back on its support.
Vector3 MovesAsLetGo(const UncertainWorld& world, const LettingGo& work) {
  Vector3 moves = SlideOfPads(world, work.draw, work.released) * work.motion.cwiseAbs();
  if (!ComesUpright(world, work.hold, work.X_WorldPart)) {
    const Vector3 up = VerticalInTool(work.X_WorldPart * work.hold.X_PartTool);
    const double across = 2 * world.problem().part(work.part).model->shape().radius();
    moves.array() += across * LeaningOf(world, up, work.draw).levelling;
  }
  return moves;
}

double AngleOf(const UncertainWorld& world, const ManipulatorError& draw) {
  return Magnitude(world.RangeOf(draw.theta));
}

PossibleFrame CommandedTool(const UncertainWorld& world, const Pose& X_WorldTool,
                            const ManipulatorError& draw) {
  return {X_WorldTool, algebra::Simplify(AsTransform(X_WorldTool) * draw.AsTransform()),
          AngleOf(world, draw)};
}

// Returns the frame of the hand after its motion to the place where the part meets its support.
PossibleFrame ToolAtEnd(const UncertainWorld& world, const LettingGo& work) {
  const Pose X_WorldTool = work.X_WorldPart * work.hold.X_PartTool;
  const Transform commanded = AsTransform(X_WorldTool) * work.draw.AsTransform();
  return {X_WorldTool, algebra::Simplify(Displaced(commanded, work.farther, work.motion)),
          AngleOf(world, work.draw)};
}

// Returns the frame of the hand after a strategy. The hand yields to the walls, and so does the
// part in the hand.
PossibleFrame ToolLed(const UncertainWorld& world, const LettingGo& work) {
  const Transform led = PossiblePose(work.X_WorldPart, work.released) *
                        AsTransform(work.hold.X_PartTool) *
                        algebra::Inverse(GraspInHand(world.held()));
  return {work.X_WorldPart * work.hold.X_PartTool, algebra::Simplify(led),
          Magnitude(world.RangeOf(work.released.theta)) + OffInHandOf(world, world.held()).turn};
}

}  // namespace

std::vector<Precondition> HandClearanceAtGrasp(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held, bool opens_again) {
  const Pose X_WorldTool = world.X_WorldPart(part) * hold.X_PartTool;
  HandConditions conditions(world, part, hold, CommandedTool(world, X_WorldTool, draw));
  conditions.RequireClearOfOthers({part}, world.ShiftAt(part, X_WorldTool.translation()),
                                  Vector3::Zero(), {});
  conditions.RequireClearOfTaken();
  conditions.RequireClearOfHeld(
      held, Vector3::Zero(),
      opens_again ? HandConditions::Leaves::kYes : HandConditions::Leaves::kNo);
  return conditions.Take();
}

std::vector<Precondition> HandClearanceAtPutdown(const UncertainWorld& world,
                                                 const LettingGo& work) {
  HandConditions conditions(world, work.part, work.hold, ToolAtEnd(world, work));
  conditions.RequireClearOfOthers({work.part}, {}, Vector3::Zero(), {});
  conditions.RequireClearOfHeld(world.held(), MovesAsLetGo(world, work),
                                HandConditions::Leaves::kYes);
  return conditions.Take();
}

std::vector<Precondition> HandClearanceAtMating(const UncertainWorld& world, domain::MatingId id,
                                                const LettingGo& work, bool is_led) {
  const domain::Mating& mating = world.problem().mating(id);
  const PossibleFrame tool = is_led ? ToolLed(world, work) : ToolAtEnd(world, work);
  const Vector3 moves =
      MovesAsLetGo(world, work).array() + world.problem().workcell->rules().lateral_compliance;
  const std::vector<Drag> drags =
      is_led ? std::vector<Drag>() : DragsOf(world, id, work.hold, work.draw);
  const double dragged = ReachOfDrag(world.problem(), drags, mating.fixed);
  const Vector3 way_in = -LengthOfWay(world, id, work.farther) * work.motion;
  HandConditions conditions(world, work.part, work.hold, tool);
  conditions.RequireClearOfOthers({mating.held, mating.fixed},
                                  world.ShiftAt(mating.fixed, tool.planned.translation()), way_in,
                                  drags);
  conditions.RequireClearOfFixed(mating.fixed, way_in, moves.array() + dragged);
  conditions.RequireClearOfHeld(world.held(), moves, HandConditions::Leaves::kYes);
  return conditions.Take();
}

}  // namespace assay::uncertainty
