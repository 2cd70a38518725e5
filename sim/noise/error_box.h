#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::noise {

using domain::PartId;
using geometry::Pose;
using plan::StepId;

// The effect of a bounded error.
enum class Effect {
  kPartX,  // displacement of a part's origin from where it is believed, world's axes, metres
  kPartY,
  kPartYaw,      // turn of a part about the world's z axis through its origin, radians
  kTableHeight,  // height of the table under a part above its nominal height, metres
  kHandX,        // displacement of the hand from its commanded pose, hand's axes, metres
  kHandY,
  kHandZ,
  kHandYaw,  // turn of the hand about its own z axis, radians
  kSensedX,  // error of a sensor: true minus measured place, world's axes, metres
  kSensedY,
  kSensedZ,
  kSensedYaw,    // error of a sensor: true minus measured yaw, radians
  kClearance,    // clearance on each side of a mated shaft minus the problem's, metres
  kFriction,     // the parts' friction minus that in their files
  kPadFriction,  // the pads' friction minus the workcell's value
};

domain::Dimension DimensionOf(Effect effect);

// One bounded variable that the planner assumes.
struct Channel {
  std::string
      name;  // "dx_block", "dz_hand@action_3": a plan::ErrorKind with its place, or a tolerance
  Effect effect = Effect::kPartX;
  PartId part = PartId::None();  // None: the hand, or the whole workcell
  // The step whose hand, sensor or table the channel concerns; None if the channel exists from the
  // start.
  StepId step = StepId::None();
  Interval range;

  bool operator==(const Channel&) const = default;
};

// Returns the dimension of the channel with this name.
domain::Dimension DimensionOfChannel(std::string_view name);

// Returns every variable that the planner assumes when it certifies the plan, with the bounds that
// the planner takes from the problem:
//
// - errors of parts at the start, and tolerances
// - errors of the hand, drawn anew for each step that manipulates
// - errors of a sensor within its promise, for each look
// - the table's height where a part is put down
//
// A part that is assembled at the start has the height error of the part that carries it, and no
// channel of its own. Channels without width are left out. Channels that exist from the start come
// first, the others in the order of execution.
std::vector<Channel> ErrorBox(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::noise
