#include "sim/cli/tasks/planned_problem.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/plan_check.h"
#include "planner/plan/plan_files/plan_file.h"
#include "planner/verify/plan_verification.h"
#include "sim/cli/command_line/progress.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

fs::path FindScenario(const fs::path& named, const fs::path& plan_file) {
  std::error_code ignored;
  const fs::path beside = plan_file.parent_path() / named;
  return !fs::exists(named, ignored) && fs::exists(beside, ignored) ? beside : named;
}

// Shows on a terminal what is being verified.
class Verification {
 public:
  explicit Verification(const PlannedProblem& planned)
      : submitted_{planned.problem, planned.result.plan, planned.file(), !planned.plan_file.empty(),
                   [this](std::string_view part) {
                     progress_.emplace(fmt::format("{} for {}", part, submitted_.problem.name));
                   }} {}

  const verify::Submitted& submitted() const { return submitted_; }

 private:
  std::optional<Progress> progress_;
  verify::Submitted submitted_;
};

void Locate(const PlannedProblem& planned, std::vector<plan::Flaw>& flaws) {
  for (plan::Flaw& flaw : flaws) {
    const auto step = static_cast<std::size_t>(flaw.step.index());
    if (!flaw.step.IsNone() && step < planned.places.size()) flaw.place = planned.places[step];
  }
}

void RequireGoal(const Document& document, const domain::Problem& problem) {
  if (!problem.goals.empty()) return;
  throw InputError({.file = document.file()}, "the goal is about knowledge, so its plan is a tree",
                   "a scenario with a key `goal`; assay plan and assay run also accept plan trees");
}

// Runs both phases of the planner, and shows progress to people on a terminal.
plan::PlanResult PlanWithProgress(const domain::Problem& problem,
                                  const constraint_posting::PlannerOptions& planner,
                                  const constraint_posting::UncertaintyOptions& uncertainty) {
  const Progress progress("planning " + problem.name);
  return assembly::MakeCertifiedPlan(problem, planner, uncertainty);
}

// Returns why a file's answer without a plan does not hold. A file has no proof that no plan
// exists, so the planner has to find the same proof again.
std::vector<plan::Flaw> FlawsWithoutPlan(const PlannedProblem& planned) {
  const plan::PlanResult& stated = planned.result;
  const auto flaw = [](const char* what) { return std::vector{plan::Flaw{{}, what}}; };
  if (!stated.plan.steps.empty()) return flaw("the file says that there is no plan, but has one");
  if (stated.outcome != Outcome::kNone) return {};
  const plan::PlanResult anew = PlanWithProgress(planned.problem, {}, {});
  if (anew.outcome == Outcome::kFound) {
    return flaw("the file says that no plan exists, but the planner finds one");
  }
  if (anew.outcome != Outcome::kNone) {
    return flaw("the file says that no plan exists, but the planner does not prove it");
  }
  if (TextsOf(anew.conflict) != TextsOf(stated.conflict) || anew.hypotheses != stated.hypotheses ||
      TextsOf(anew.near_misses) != TextsOf(stated.near_misses)) {
    return flaw("the file gives other reasons than the planner why no plan exists");
  }
  return {};
}

}  // namespace

std::vector<domain::Problem> ReadWorldsToPlan(const Document& document,
                                              const domain::ModelPath& models,
                                              const scenario::Overrides& overrides) {
  std::vector<domain::Problem> worlds = scenario::ReadWorlds(document, models, overrides);
  RequireGoal(document, worlds.front());
  return worlds;
}

PlannedProblem ReadPlan(const Document& plan_file, const domain::ModelPath& models) {
  const fs::path path = FindScenario(plan::ScenarioOf(plan_file), plan_file.file());
  scenario::Scenario scenario = scenario::Load(path, models);
  plan::PlanResult result = plan::ReadPlan(plan_file, scenario.problem);
  std::vector<FilePlace> places;
  for (const Value& action : plan_file.root().At("actions").Items()) {
    places.push_back(action.Place());
  }
  return {path.string(),
          std::move(scenario.problem),
          std::move(scenario.simulation),
          std::move(result),
          plan_file.file(),
          std::move(places)};
}

PlannedProblem MakePlan(const Document& document, scenario::Scenario scenario,
                        const constraint_posting::PlannerOptions& planner,
                        const constraint_posting::UncertaintyOptions& uncertainty) {
  RequireGoal(document, scenario.problem);
  plan::PlanResult result = PlanWithProgress(scenario.problem, planner, uncertainty);
  return {document.file(), std::move(scenario.problem), std::move(scenario.simulation),
          std::move(result)};
}

PlannedProblem ReadOrMakePlan(const Document& document, const domain::ModelPath& models) {
  return IsPlanFile(document) ? ReadPlan(document, models)
                              : MakePlan(document, scenario::Read(document, models), {}, {});
}

bool IsPlanFile(const Document& document) {
  return document.root().At("format").OneOf({"assay-scenario/1", "assay-plan/2"}) == 1;
}

plan::CheckReport CheckPlan(const domain::Problem& problem, const plan::Plan& plan) {
  const Progress progress("checking the plan for " + problem.name);
  return assembly::Check(problem, plan, kMostLinearizations);
}

plan::CheckReport CheckPlan(const PlannedProblem& planned) {
  if (planned.result.outcome != Outcome::kFound) return {.flaws = FlawsWithoutPlan(planned)};
  const Verification verification(planned);
  plan::CheckReport report = verify::Verify(verification.submitted(), kMostLinearizations);
  Locate(planned, report.flaws);
  return report;
}

void RequireSound(const PlannedProblem& planned) {
  if (planned.plan_file.empty()) return;
  const plan::CheckReport report = CheckPlan(planned);
  if (report.flaws.empty()) return;
  const plan::Flaw& first = report.flaws.front();
  FilePlace place = first.place;
  if (place.line == 0) place.file = planned.plan_file;
  throw InputError(place, fmt::format("the plan has a flaw: {}", first.what),
                   "a plan in which assay check finds no flaws");
}

}  // namespace assay::cli
