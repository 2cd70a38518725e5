#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/check/checker.h"
#include "planner/plan/data/plan.h"
#include "planner/posting/uncertainty_phase/uncertainty_phase.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {

// What verbs work on that take a scenario or a plan file.
struct PlannedProblem {
  std::string scenario;  // path of the scenario file, as the user gave it
  domain::Problem problem;
  scenario::Simulation simulation;
  plan::PlanResult result;
  std::string plan_file = {};          // path; empty: the plan was made for the scenario
  std::vector<FilePlace> places = {};  // of the steps in it

  const std::string& file() const { return plan_file.empty() ? scenario : plan_file; }
};

// All throw InputError for what is wrong in a file. `models`: the folder given, or empty.

// The problems of all worlds that a scenario allows (domain::ReadWorlds), which says what is to be
// assembled.
std::vector<domain::Problem> ReadWorldsToPlan(const Document& document,
                                              const domain::ModelPath& models,
                                              const scenario::Overrides& overrides = {});

// Of the two formats, throws InputError if the file has neither.
bool IsPlanFile(const Document& document);

// A plan file, with the problem in the scenario that it names: a path from the working directory
// or, if there is no such file, from the plan file's folder.
PlannedProblem ReadPlan(const Document& plan_file, const domain::ModelPath& models);

// For a scenario, of which `document` is the file.
PlannedProblem MakePlan(const Document& document, scenario::Scenario scenario,
                        const posting::PlannerOptions& planner,
                        const posting::UncertaintyOptions& uncertainty);

// A plan file is read; for a scenario a plan is made.
PlannedProblem ReadOrMakePlan(const Document& document, const domain::ModelPath& models);

// Both phases of the planner, with progress for people on a terminal.
plan::PlanResult PlanWithProgress(const domain::Problem& problem,
                                  const posting::PlannerOptions& planner,
                                  const posting::UncertaintyOptions& uncertainty);

// The independent checker, over at most this many orders of the steps, and whether strategies of
// fine motion hold up (planner/assembly/plan_check.h).
inline constexpr int kMostLinearizations = 1000;
plan::CheckReport CheckPlan(const domain::Problem& problem, const plan::Plan& plan);
// The same, and whether the certificates' claims hold up (planner/verify) and, of a plan file,
// are those of the scenario (certificate_comparison.h).
plan::CheckReport CheckPlan(const PlannedProblem& planned);
// Of claims and strategies: what a plan says of itself.
std::vector<plan::Flaw> CertificateFlaws(const PlannedProblem& planned);

}  // namespace assay::cli
