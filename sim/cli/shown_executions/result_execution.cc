#include <fmt/format.h>

#include "planner/base/input_files/input_error.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/shown_executions/plan_of_request.h"
#include "sim/cli/shown_executions/trial_execution.h"
#include "sim/cli/tasks/noise_floor_cache.h"

namespace assay::cli {
namespace {

// A trial or counterexample that a result lists.
struct ListedTrial {
  std::string name;
  Value noise;
};

// A falsification lists counterexamples, any other run lists trials by their numbers.
ListedTrial FindListed(const Value& result, const ShowRequest& request) {
  const bool is_falsification = result.Find("counterexamples").has_value();
  const std::string kind = is_falsification ? "counterexample" : "trial";
  if (!request.number)
    throw UsageError(fmt::format("{}: a result needs the number of a {}", request.verb, kind));
  const std::vector<Value> rows = result.At(is_falsification ? "counterexamples" : "rows").Items();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int number = is_falsification
                           ? static_cast<int>(i) + 1
                           : rows[i].At("trial").Integer(1, std::numeric_limits<int>::max());
    if (number != *request.number) continue;
    return {fmt::format("{} {}", kind, number), rows[i].At("noise")};
  }
  throw UsageError(fmt::format("{}: {} has no {} {}; it has {} of them", request.verb,
                               request.input.string(), kind, *request.number, rows.size()));
}

}  // namespace

ShownExecution ResultExecution(const ShowRequest& request) {
  const Document result = Document::Load(request.input);
  const auto [name, noise] = FindListed(result.root(), request);
  PlannedProblem planned = PlanOf(request);
  const auto& [problem, plan] = std::tie(planned.problem, planned.result.plan);
  scene::SceneOptions& scene = planned.simulation.scene;
  const bool is_weld = result.root().At("grasp").OneOf({"friction", "weld"}) == 1;
  scene.grasp = is_weld ? scene::GraspMode::kWeld : scene::GraspMode::kFriction;
  const auto sensing = result.root().Find("sensing");
  const bool is_camera = sensing && sensing->OneOf({"drawn", "camera"}) == 1;
  const check::Experiment experiment{problem, plan, scene, KeptNoiseFloor(problem, plan, scene)};
  check::Trial trial = [&, &name = name, &noise = noise] {
    const Progress progress(name);
    return check::RunTrial(experiment,
                           noise::ParseNoise(noise.Text(), noise::ErrorBox(problem, plan)), {},
                           is_camera ? check::Sensing::kCamera : check::Sensing::kDrawn);
  }();
  return TrialExecution(experiment, std::move(trial),
                        fmt::format("{} in {}", name, request.input.string()), planned.plan_file);
}

}  // namespace assay::cli
