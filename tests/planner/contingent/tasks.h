#pragma once

#include <algorithm>
#include <string>

#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/pks_and_pddl/pks_file.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "planner/contingent/search/contingent_planner.h"

// Tasks for tests, from text and from the scenarios.
namespace assay::contingent {

inline GroundTask GroundText(const std::string& domain, const std::string& problem,
                             Externs externs = {}) {
  return Ground(ReadPksDomain(domain, "domain.pks"), ReadPksProblem(problem, "problem.pks"),
                externs);
}

inline GroundTask GroundScenario(const std::string& domain, const std::string& problem) {
  const std::string folder = ASSAY_SOURCE_DIR "/scenarios/know/";
  const Task task = LoadTask(folder + domain + ".pks", folder + problem + ".pks");
  Externs externs;
  return Ground(task.domain, task.problem, externs);
}

inline ContingentPlan PlanFor(const GroundTask& task, Wanted wanted,
                              std::int64_t states = 1'000'000) {
  Budget budget(states);
  return MakePlan(task, wanted, budget);
}

// Returns the message of the InputError, or "no error".
template <class Function>
std::string MessageOf(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// These functions make nodes of trees by hand. Their arguments are the places of the next nodes.
inline PlanNode ActOf(const GroundTask& task, const std::string& name, int then) {
  const auto action = std::ranges::find(task.actions, name, &GroundAction::name);
  PlanNode node;
  node.kind = PlanNode::Kind::kAct;
  node.action = ActionId(static_cast<int>(action - task.actions.begin()));
  node.children = {NodeId(then)};
  return node;
}

inline PlanNode BranchOf(const GroundTask& task, const std::string& formula, int if_true,
                         int if_false) {
  const auto is_asked = [&](const Formula& f) { return TextOf(task, f) == formula; };
  const auto asked = std::ranges::find_if(task.formulas, is_asked);
  PlanNode node;
  node.kind = PlanNode::Kind::kWhether;
  node.formula = FormulaId(static_cast<int>(asked - task.formulas.begin()));
  node.children = {NodeId(if_true), NodeId(if_false)};
  return node;
}

}  // namespace assay::contingent
