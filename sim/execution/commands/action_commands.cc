#include "sim/execution/commands/action_commands.h"

#include <algorithm>

#include "planner/base/check.h"

namespace assay::execution {
namespace {

bool GoesTo(const Command& command, const Pose& X_WorldTool) {
  const auto* line = std::get_if<MoveStraight>(&command);
  return line != nullptr && line->X_WorldTool.isApprox(X_WorldTool);
}

Command& TravelOf(std::vector<Command>& commands) {
  return *std::ranges::find_if(commands, [](const Command& command) {
    return std::holds_alternative<MoveAtSafeHeight>(command);
  });
}

// Replaces all moves up to where the tool is poised by the path.
void ComeByPath(const std::vector<kinematics::JointVector>& path, const plan::ToolRoute& route,
                StepCommands& commands) {
  std::erase_if(commands.approach,
                [&](const Command& command) { return GoesTo(command, route.poised); });
  TravelOf(commands.approach) = FollowPath{path, route.poised};
  for (Command& command : commands.withdraw) {
    auto* line = std::get_if<MoveStraight>(&command);
    if (line != nullptr) line->X_WorldTool = route.poised;
  }
}

// Sets the usual way, which goes through the planned postures.
void ComeOver(const std::vector<kinematics::JointVector>& path, StepCommands& commands) {
  Command& travel = TravelOf(commands.approach);
  travel = FollowPath{path, std::get<MoveAtSafeHeight>(travel).X_WorldTool};
}

// Lets the last line go no higher than the retreat.
void StayLow(const plan::ToolRoute& route, StepCommands& commands) {
  if (commands.depart.empty()) return;
  auto& last = std::get<MoveStraight>(commands.depart.back());
  last.X_WorldTool = route.left();
  const std::size_t count = commands.depart.size();
  if (count > 1 && GoesTo(commands.depart[count - 2], route.left())) commands.depart.pop_back();
}

bool IsLeftByPath(const plan::Plan& plan, plan::StepId step) {
  const int place = plan.step(step).executed;
  const bool is_last = place == static_cast<int>(plan.steps.size());
  const auto next = std::ranges::find(plan.steps, place + 1, &plan::PlannedStep::executed);
  const std::optional<plan::Travel>& travel = is_last ? plan.homing : next->travel;
  return travel && !travel->is_usual;
}

}  // namespace

void ClampFixed(const domain::Problem& problem, const domain::Mating& mating,
                StepCommands& commands) {
  const double clamp = problem.part(mating.fixed).clamp;
  if (clamp == 0) return;
  commands.advance.insert(commands.advance.begin(), Clamp{mating.fixed, clamp});
  commands.depart.insert(commands.depart.begin() + 1, Clamp{mating.fixed, 0});
}

std::vector<Command> StepCommands::InOrder() const {
  std::vector<Command> commands;
  for (const auto* phase : {&approach, &advance, &act, &depart}) {
    commands.insert(commands.end(), phase->begin(), phase->end());
  }
  return commands;
}

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::PlannedStep& step) {
  return CommandsFor(problem, world, step.action, step.certificate,
                     step.strategy ? &*step.strategy : nullptr);
}

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Action& action, const plan::Certificate& certificate,
                         const plan::Strategy* strategy) {
  if (action.kind->Has(domain::Argument::kSensor)) {
    return CommandsToLook(problem, action, certificate);
  }
  ASSAY_CHECK(plan::HoldIn(action) != nullptr, "no commands do {}", action.kind->name);
  switch (action.kind->leaves) {
    case domain::Leaves::kInHand:
      return CommandsToTake(problem, world, action);
    case domain::Leaves::kWhereItWas:
      return CommandsToSqueeze(problem, world, action);
    case domain::Leaves::kAtPlace:
      return CommandsToPutDown(problem, action, certificate);
    case domain::Leaves::kMated:
      break;
  }
  return strategy != nullptr ? CommandsToMateBy(*strategy, problem, world, action)
                             : CommandsToMate(problem, world, action, certificate);
}

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Plan& plan, plan::StepId id) {
  const plan::PlannedStep& step = plan.step(id);
  StepCommands commands = CommandsFor(problem, world, step);
  const Pose& X_WorldPart = world.PartPose(plan::PlacedPart(problem, step.action));
  const plan::ToolRoute route = plan::RouteOf(problem, step, X_WorldPart);
  if (step.travel && step.travel->is_usual) ComeOver(step.travel->path, commands);
  if (step.travel && !step.travel->is_usual) ComeByPath(step.travel->path, route, commands);
  if (IsLeftByPath(plan, id)) StayLow(route, commands);
  return commands;
}

Command HomingOf(const domain::Problem& problem, const plan::Plan& plan) {
  const Pose home = plan::HomeTool(*problem.workcell);
  if (plan.homing) return FollowPath{plan.homing->path, home};
  return MoveAtSafeHeight{home};
}

}  // namespace assay::execution
