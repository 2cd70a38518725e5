#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::noise {

using domain::PartId;
using geometry::Pose;
using plan::StepId;

// What a bounded error does.
enum class Effect {
  kPartX,  // a part lies elsewhere than believed: its origin along the world's axes, metres
  kPartY,
  kPartYaw,      // and it is turned about the world's z through its origin, radians
  kTableHeight,  // the table under a part is higher, metres
  kHandX,        // the hand goes elsewhere than told: along its own axes, metres
  kHandY,
  kHandZ,
  kHandYaw,  // and turned about its own z, radians
  kSensedX,  // a sensor tells a place beside the true one: true minus told, metres, world's axes
  kSensedY,
  kSensedZ,
  kSensedYaw,    // radians
  kClearance,    // on each side of a mated shaft, metres more than the problem says
  kFriction,     // of parts, more than their files say
  kPadFriction,  // of the pads, more than the workcell says
};

// One bounded variable that the planner assumes.
struct Channel {
  std::string name;  // "dx_block", "dz_hand@action_3"
  Effect effect = Effect::kPartX;
  PartId part = PartId::None();  // None: the hand's, or of the whole workcell
  // Of the step whose hand, sensor or table it is; None: it is there from the start.
  StepId step = StepId::None();
  Interval range;

  bool operator==(const Channel&) const = default;
};

// Every variable that the planner assumes when it certifies the plan, with the very bounds that it
// takes from the problem: errors of parts at the start; errors of the hand, drawn afresh for each
// step that manipulates; errors of a sensor within its promise, for each look; the table's height
// where a part is put down; tolerances. Channels without width are left out. Those that are there
// from the start come first, the others in the order of execution.
std::vector<Channel> ErrorBox(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::noise
