#pragma once

#include <vector>

#include "planner/plan/data/pushing.h"
#include "planner/plan/data/tool_route.h"
#include "sim/exec/commands/command.h"
#include "sim/exec/execution/world_model.h"

namespace assay::exec {

using plan::AtSafeHeight;
using plan::Retreated;

// The commands of one step, by what they are for: move above, straight line down, act, and up
// again (Spar, figure 18).
struct StepCommands {
  plan::StepId step = {};
  std::vector<Command> approach = {};  // until the tool is poised before or above its work
  std::vector<Command> advance = {};   // to where it works
  std::vector<Command> act = {};       // there
  std::vector<Command> depart = {};    // when that was right
  // When it was not: back to where the tool was poised. Empty: it is enough to back off a little.
  std::vector<Command> withdraw = {};

  // Without `withdraw`, in the order of execution.
  std::vector<Command> InOrder() const;
};

// The commands of a step of a plan, from where the parts are believed to be. Straight lines down
// and up are vertical; the last piece to a part and the first away from it are along the tool's
// axis, as long as the workcell's approach distance. Parts that are put down or mated go on until
// they meet resistance, or until they must have met it (BeyondContact). The arm comes as the plan's
// travel has it: the usual way, or by a path from where the step before has left the tool
// (plan::RouteOf), and then neither goes up.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Plan& plan, plan::StepId step);
// After the last step.
Command HomingOf(const domain::Problem& problem, const plan::Plan& plan);

// The same with the usual travel.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::PlannedStep& step);
// Of the actions. `certificate`: what is known of the step; empty: nothing. The fixed part of a
// mating is clamped by its fixture, if it has one (domain::Part::clamp).
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Pickup& pickup, const plan::Certificate& certificate = {});
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Putdown& putdown, const plan::Certificate& certificate = {});
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Assemble& assemble, const plan::Certificate& certificate = {});
// The same by fine motion.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Assemble& assemble, const plan::Strategy& strategy);
// The arm first goes to its home, so that it hangs over no part that does not lie there.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Sense& sense, const plan::Certificate& certificate = {});
// Closes on the part as a pickup does, and lets it go where it is.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Squeeze& squeeze, const plan::Certificate& certificate = {});

// What a guarded move takes for resistance: more than what starting and stopping the hand exerts.
using plan::kResistance;

// How far a guarded move goes beyond where contact is expected, metres: until it must have been
// made, so that pads that bear less than the resistance slide no farther on the part; no farther
// than the workcell's guarded travel.
double BeyondContact(const domain::Problem& problem, const plan::Certificate& certificate);
// Adds that the fixed part's fixture, if it has one, clamps it until the held part is let go.
void ClampFixed(const domain::Problem& problem, const domain::Mating& mating,
                StepCommands& commands);

}  // namespace assay::exec
