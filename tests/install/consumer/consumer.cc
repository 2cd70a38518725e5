#include "planner/domain/problem_file.h"
#include "planner/posting/posting_planner.h"

int main() {
  const std::filesystem::path data = DATA_DIR;
  const auto scenario = assay::Document::Load(data / "scenarios/spar-fig15.yaml");
  const auto problem = assay::domain::ReadProblem(scenario, data / "models");
  const auto result = assay::posting::MakePlan(problem, {});
  return result.plan.steps.size() == 2 ? 0 : 1;  // pickup, assemble
}
