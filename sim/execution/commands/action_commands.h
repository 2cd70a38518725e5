#pragma once

#include <vector>

#include "planner/plan/certificates/pushing.h"
#include "planner/plan/data/tool_route.h"
#include "sim/execution/commands/command.h"
#include "sim/execution/world_model/world_model.h"

namespace assay::execution {

using plan::AtSafeHeight;
using plan::Retreated;

// The commands of one step, in phases: move above, go down a straight line, act, and go up again
// (Spar, figure 18).
struct StepCommands {
  plan::StepId step = {};
  std::vector<Command> approach = {};  // commands until the tool is poised before or above its work
  std::vector<Command> advance = {};   // commands that bring the tool to where the step acts
  std::vector<Command> act = {};       // commands at the place of work
  std::vector<Command> depart = {};    // commands that move the tool away, if the work succeeded
  // Commands that move the tool back to where it was poised, if the work failed. If there are none,
  // it is enough that the tool backs off a little.
  std::vector<Command> withdraw = {};

  // Returns all commands but those of `withdraw`, in the order of execution.
  std::vector<Command> InOrder() const;
};

// Returns the commands of a step of a plan, for the believed poses of the parts. Straight lines
// down and up are vertical. The last piece to a part and the first piece away from it are along the
// tool's axis, with the workcell's approach distance as length. A part that is put down or mated
// moves on until it meets resistance, or until it must have met resistance (plan::BeyondContact).
// The arm comes to the step by the plan's travel. The travel is the usual one, or a path that
// begins where the previous step left the tool (plan::RouteOf). With a path, the arm does not go up
// to safe height between the two steps.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Plan& plan, plan::StepId step);
// Returns the command after the last step.
Command HomingOf(const domain::Problem& problem, const plan::Plan& plan);

// Returns the commands of a step with the usual travel.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::PlannedStep& step);
// Returns the commands of an action. `certificate` holds what is known about the step; it is empty
// if nothing is known. `strategy` executes a mating by fine motion. If it is null, the mating is a
// straight motion.
StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Action& action, const plan::Certificate& certificate = {},
                         const plan::Strategy* strategy = nullptr);

// These functions return the commands of one kind of action each; CommandsFor calls them. A mating
// clamps the fixed part if it has a fixture (domain::Part::clamp).
StepCommands CommandsToTake(const domain::Problem& problem, const WorldModel& world,
                            const plan::Action& pickup);
StepCommands CommandsToPutDown(const domain::Problem& problem, const plan::Action& putdown,
                               const plan::Certificate& certificate);
StepCommands CommandsToMate(const domain::Problem& problem, const WorldModel& world,
                            const plan::Action& assemble, const plan::Certificate& certificate);
StepCommands CommandsToMateBy(const plan::Strategy& strategy, const domain::Problem& problem,
                              const WorldModel& world, const plan::Action& assemble);
// The arm first goes home, so that it hangs over no part except a part that lies below the home
// posture.
StepCommands CommandsToLook(const domain::Problem& problem, const plan::Action& sense,
                            const plan::Certificate& certificate);
// The gripper closes on the part as in a pickup, and releases it in place.
StepCommands CommandsToSqueeze(const domain::Problem& problem, const WorldModel& world,
                               const plan::Action& squeeze);

// The force at which a guarded move stops. It exceeds what starting and stopping the hand exerts.
using plan::kResistance;

// If the fixed part has a fixture, adds the commands that clamp the fixed part until the held part
// is released.
void ClampFixed(const domain::Problem& problem, const domain::Mating& mating,
                StepCommands& commands);

}  // namespace assay::execution
