#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {

// The input of verbs that take a scenario or a plan file.
struct PlannedProblem {
  std::string scenario;  // path of the scenario file, as the user gave it
  domain::Problem problem;
  scenario::Simulation simulation;
  plan::PlanResult result;
  std::string plan_file = {};          // path; empty if the plan was made for the scenario
  std::vector<FilePlace> places = {};  // places of the steps in the plan file

  const std::string& file() const { return plan_file.empty() ? scenario : plan_file; }
};

// All functions here throw InputError for errors in a file. `models` are the given folders, or
// empty.

// Reads, for verbs that plan, the problems of all worlds that a scenario allows
// (domain::ReadWorlds). The scenario must have a goal.
std::vector<domain::Problem> ReadWorldsToPlan(const Document& document,
                                              const domain::ModelPath& models,
                                              const scenario::Overrides& overrides = {});

// Returns whether the file is a plan file rather than a scenario file. Throws InputError if it has
// another format.
bool IsPlanFile(const Document& document);

// Reads a plan file and the problem in the scenario that it names. The scenario's path is taken
// from the working directory or, if there is no such file, from the plan file's folder.
PlannedProblem ReadPlan(const Document& plan_file, const domain::ModelPath& models);

// Makes a plan for a scenario, which was read from `document`.
PlannedProblem MakePlan(const Document& document, scenario::Scenario scenario,
                        const constraint_posting::PlannerOptions& planner,
                        const constraint_posting::UncertaintyOptions& uncertainty);

// Reads the plan if `document` is a plan file, and makes one if it is a scenario.
PlannedProblem ReadOrMakePlan(const Document& document, const domain::ModelPath& models);

// Runs the independent checker over at most this many orders of the steps, and checks that
// strategies of fine motion hold up (planner/assembly/plan_check.h).
inline constexpr int kMostLinearizations = 1000;
plan::CheckReport CheckPlan(const domain::Problem& problem, const plan::Plan& plan);
// Makes the checks of the function above, and verifies the certificates' claims (planner/verify).
// If the plan comes from a plan file, it also checks that the certificates are those that the
// scenario gives (certificate_comparison.h). If the file says that no plan exists, the planner has
// to find the same reasons.
plan::CheckReport CheckPlan(const PlannedProblem& planned);
// Throws InputError if the plan comes from a plan file and the check finds flaws in it.
void RequireSound(const PlannedProblem& planned);

}  // namespace assay::cli
