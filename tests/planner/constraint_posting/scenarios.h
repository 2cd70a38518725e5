#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "planner/constraint_posting/posting_planner.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

inline domain::Problem LoadScenario(const std::string& name) {
  const std::string root = ASSAY_SOURCE_DIR;
  return domain::ReadProblem(Document::Load(root + "/scenarios/" + name + ".yaml"),
                             root + "/models");
}

// Reads a scenario from its text, with the models of the project.
inline domain::Problem ScenarioFrom(const std::string& text) {
  return domain::ReadProblem(Document::Parse(text, "scenario.yaml"),
                             std::string(ASSAY_SOURCE_DIR) + "/models");
}

inline domain::PartId PartNamed(const domain::Problem& problem, const std::string& name) {
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    if (problem.parts[i].name == name) return domain::PartId(i);
  }
  return domain::PartId::None();
}

// Returns the first plan instance, without regard to uncertainty.
inline plan::Plan FirstInstance(const domain::Problem& problem) {
  return MakePlan(problem, {}).plan;
}

// Returns the first plan instances, at most `most` of them.
inline std::vector<plan::Plan> Instances(const domain::Problem& problem, std::size_t most) {
  std::vector<plan::Plan> instances;
  PlannerOptions options;
  options.accept = [&](const plan::Plan& instance) {
    instances.push_back(instance);
    return instances.size() >= most;
  };
  MakePlan(problem, options);
  return instances;
}

// Returns the actions of a plan in the order of execution.
inline std::vector<plan::Action> ActionsOf(const plan::Plan& plan) {
  std::vector<plan::Action> actions;
  for (const plan::StepId id : plan.ExecutionOrder()) actions.push_back(plan.step(id).action);
  return actions;
}

// Returns the number of actions of one kind.
inline std::ptrdiff_t Count(const domain::ActionKind& kind,
                            const std::vector<plan::Action>& actions) {
  return std::ranges::count(actions, &kind, &plan::Action::kind);
}

// Returns the text of a scenario like Spar's example, with these stable poses of the parts.
inline std::string PegAndBlock(const std::string& block_pose, const std::string& peg_pose,
                               const std::string& more = "") {
  return R"(format: assay-scenario/1
units: {length: inch, angle: degree}
workcell: puma762-table
parts:
  block: {model: block, pose: )" +
         block_pose + R"(}
  peg: {model: peg, pose: )" +
         peg_pose + R"(}
goal:
  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],
                pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [3, 0, 3.25]]},
                mating_vector: [-4, 0, 0]}
)" + more;
}

}  // namespace assay::constraint_posting
