#include "sim/cli/planned_problem.h"

#include "planner/domain/problem_file.h"
#include "planner/plan/plan_file.h"
#include "sim/cli/file_format.h"
#include "sim/cli/models_folder.h"
#include "sim/cli/progress.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

fs::path FindScenario(const fs::path& named, const fs::path& plan_file) {
  std::error_code ignored;
  const fs::path beside = plan_file.parent_path() / named;
  return !fs::exists(named, ignored) && fs::exists(beside, ignored) ? beside : named;
}

}  // namespace

domain::Problem LoadProblem(const fs::path& scenario, const fs::path& models) {
  const Document document = Document::Load(scenario);
  return domain::ReadProblem(document, FindModels(models, scenario));
}

PlannedProblem LoadPlan(const Document& plan_file, const fs::path& file, const fs::path& models) {
  const fs::path scenario = FindScenario(plan::ScenarioOf(plan_file), file);
  domain::Problem problem = LoadProblem(scenario, models);
  plan::PlanResult result = plan::ReadPlan(plan_file, problem);
  return {scenario.string(), std::move(problem), std::move(result)};
}

PlannedProblem LoadOrMakePlan(const fs::path& file, const fs::path& models) {
  const Document document = Document::Load(file);
  const Value format = document.root().At("format");
  if (format.OneOf({"assay-scenario/1", "assay-plan/1"}) == 1) {
    return LoadPlan(document, file, models);
  }
  domain::Problem problem = domain::ReadProblem(document, FindModels(models, file));
  plan::PlanResult result = MakePlan(problem, {});
  return {file.string(), std::move(problem), std::move(result)};
}

plan::PlanResult MakePlan(const domain::Problem& problem, const posting::PlannerOptions& options) {
  const Progress progress("planning " + problem.name);
  return posting::MakePlan(problem, options);
}

plan::CheckReport CheckPlan(const domain::Problem& problem, const plan::Plan& plan) {
  const Progress progress("checking the plan for " + problem.name);
  return plan::Check(problem, plan, kMostLinearizations);
}

}  // namespace assay::cli
