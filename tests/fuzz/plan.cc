// The target reads a plan file of the scenario `uncertain-known` and runs the independent checker
// on it.

#include "planner/assembly/plan_check.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/plan/plan_files/plan_file.h"
#include "tests/fuzz/reader_input.h"

namespace {

assay::domain::Problem ReadScenario() {
  const std::filesystem::path file =
      std::filesystem::path(ASSAY_SOURCE_DIR) / "scenarios" / "uncertain-known.yaml";
  return assay::domain::ReadProblem(assay::Document::Load(file), assay::fuzz::kModels);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  static const domain::Problem problem = ReadScenario();
  const std::string text = fuzz::TextOf(data, size);
  return fuzz::RefusesOrDoes([&] {
    const Document document = Document::Parse(text, "plan.json");
    plan::ScenarioOf(document);
    const plan::PlanResult result = plan::ReadPlan(document, problem);
    if (result.outcome == Outcome::kFound) assembly::Check(problem, result.plan, 3);
  });
}
