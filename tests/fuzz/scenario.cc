// The target reads a scenario file. Now and then it plans the scenario, checks the plan, and steps
// the simulation.

#include "sim/scenario/scenario.h"
#include "planner/assembly/plan_check.h"
#include "planner/base/check.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/domain/problem/problem_file.h"
#include "sim/scene/scene.h"
#include "tests/fuzz/reader_input.h"

namespace assay::fuzz {
namespace {

constexpr std::size_t kMostParts = 3;
constexpr int kOneInPlanned = 40;
constexpr int kSteps = 20;

// Plans with a small budget and without paths of travels, because their search alone takes seconds
// under sanitizers.
plan::PlanResult SmallPlan(const domain::Problem& problem) {
  const constraint_posting::PlannerOptions planner = {.partial_plans = 200,
                                                      .instance_choices = 200};
  constraint_posting::UncertaintyOptions uncertainty;
  uncertainty.bound.evaluations = 1000;
  uncertainty.combinations = 3;
  uncertainty.snapshots = 100;
  uncertainty.instances = 1;
  return constraint_posting::MakeCertifiedPlan(problem, planner, uncertainty);
}

void PlanAndCheck(const domain::Problem& problem) {
  const plan::PlanResult result = SmallPlan(problem);
  if (result.outcome != Outcome::kFound) return;
  const plan::CheckReport report = assembly::Check(problem, result.plan, 3);
  ASSAY_CHECK(report.flaws.empty(), "the checker refuses a plan of the planner: {}",
              report.flaws.front().what);
}

void StepInEngine(const scenario::Scenario& read) {
  const scene::Scene scene(read.problem, read.simulation.scene);
  mujoco::Data data = scene.Start();
  for (int i = 0; i < kSteps; ++i) data.Step();
}

}  // namespace
}  // namespace assay::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  const std::string text = fuzz::TextOf(data, size);
  return fuzz::RefusesOrDoes([&] {
    const Document document = Document::Parse(text, "fuzzed.yaml");
    domain::ReadWorlds(document, fuzz::kModels, {});
    const scenario::Scenario read = scenario::Read(document, fuzz::kModels);
    if (read.problem.parts.size() > fuzz::kMostParts) return;
    if (!fuzz::IsOneIn(fuzz::kOneInPlanned, text)) return;
    fuzz::PlanAndCheck(read.problem);
    fuzz::StepInEngine(read);
  });
}
