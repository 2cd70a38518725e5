#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "planner/base/random.h"
#include "planner/finemotion/mating.h"
#include "sim/cli/console.h"
#include "sim/cli/planned_problem.h"
#include "sim/cli/progress.h"
#include "sim/cli/stopwatch.h"
#include "sim/cli/table.h"
#include "sim/cli/trial.h"
#include "sim/cli/usage_error.h"
#include "sim/cli/verb.h"
#include "sim/exec/mating_trial.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using finemotion::FineMotionPlan;
using finemotion::MatingGeometry;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMillimetre = 1e-3;
constexpr double kSeated = 1e-3;  // metres from the seat along the way in

struct Options {
  std::filesystem::path scenario;
  std::filesystem::path models;
  double displacement_mm = 2;
  double rotation_deg = 1;
  int trials = 0;
  int jobs = 1;
  std::uint64_t seed = 1;
  scene::GraspMode grasp = scene::GraspMode::kWeld;
  bool json = false;
};

// The last assemble action of a plan: what fine motion is for.
const plan::Assemble& AssembleOf(const PlannedProblem& planned) {
  const plan::Assemble* found = nullptr;
  for (const plan::StepId id : planned.result.plan.ExecutionOrder()) {
    const auto* assemble = std::get_if<plan::Assemble>(&planned.result.plan.step(id).action);
    if (assemble != nullptr) found = assemble;
  }
  if (found != nullptr) return *found;
  throw UsageError(fmt::format("mate: {}: no plan with an assemble action", planned.scenario));
}

// --- What is told of a plan.

std::string NamesOf(const std::vector<finemotion::ContactKey>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(finemotion::Name(key));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string TextOf(const finemotion::Unwanted& unwanted) {
  return fmt::format("{}{} at {:g} times the errors", unwanted.is_loss ? "loss of " : "",
                     finemotion::Name(unwanted.contact), unwanted.scale);
}

std::string TextOf(const FineMotionPlan& plan) {
  Table table({{""}, {"ends with"}, {"in contact after it"}, {"first unwanted"}});
  int number = 0;
  for (const finemotion::CertainMotion& motion : plan.motions) {
    const auto& unwanted = motion.check.unwanted;
    table.Add({fmt::format("{}", ++number),
               motion.command.until ? finemotion::Name(*motion.command.until) : "its way",
               NamesOf(motion.check.after.kept),
               unwanted.empty() ? "none" : TextOf(unwanted.front())});
  }
  return table.Text();
}

Json ToJson(const FineMotionPlan& plan) {
  Json motions = Json::array();
  for (const finemotion::CertainMotion& motion : plan.motions) {
    Json unwanted = Json::array();
    for (const auto& u : motion.check.unwanted) {
      unwanted.push_back(
          {{"contact", finemotion::Name(u.contact)}, {"loss", u.is_loss}, {"scale", u.scale}});
    }
    const Eigen::VectorXd& d = motion.command.displacement;
    Json kept = Json::array();
    for (const auto& key : motion.command.kept) kept.push_back(finemotion::Name(key));
    motions.push_back(
        {{"state", kept},
         {"velocity", std::vector<double>(d.begin(), d.begin() + 6)},
         {"until", motion.command.until ? Json(finemotion::Name(*motion.command.until)) : Json()},
         {"longest", motion.check.longest},
         {"margins", unwanted}});
  }
  return motions;
}

// --- Trials.

struct Tally {
  int seated = 0;
  std::map<std::string, int> ends;
  std::vector<std::string> failures;
  double greatest_force = 0;
};

class MatingTrials {
 public:
  MatingTrials(const PlannedProblem& planned, const plan::Assemble& assemble,
               const MatingGeometry& geometry, const Options& options)
      : planned_(planned), assemble_(assemble), geometry_(geometry), options_(options) {
    scene::SceneOptions scene = planned.simulation.scene;
    scene.grasp = options.grasp;
    scene_ = std::make_unique<scene::Scene>(planned.problem, scene);
  }

  // With a strategy, or straight in.
  Tally Run(const plan::Strategy* strategy) const {
    std::vector<exec::MatingResult> results(static_cast<std::size_t>(options_.trials));
    ForEachTrial(options_.trials, options_.jobs, [&](int number) {
      const exec::MatingSetting setting = SettingOf(number);
      auto& result = results[static_cast<std::size_t>(number - 1)];
      result = strategy != nullptr
                   ? exec::RunMatingTrial(planned_.problem, *scene_, setting, *strategy)
                   : exec::RunStraightMating(planned_.problem, *scene_, setting);
    });
    Tally tally;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const exec::MatingResult& result = results[i];
      const Pose at = result.X_FixedHeld * geometry_.X_HeldTip;
      const Vector3 left = geometry_.X_FixedSeat.translation() - at.translation();
      if (std::abs(left.dot(geometry_.passage.mating)) < kSeated) {
        ++tally.seated;
      } else {
        tally.failures.push_back(fmt::format("trial {}: {}: {}", i + 1,
                                             exec::Name(result.end.outcome), result.end.reason));
      }
      ++tally.ends[std::string(exec::Name(result.end.outcome))];
      tally.greatest_force = std::max(tally.greatest_force, result.greatest_force);
    }
    return tally;
  }

 private:
  using Pose = geometry::Pose;
  using Vector3 = geometry::Vector3;

  exec::MatingSetting SettingOf(int number) const {
    RandomStream random(options_.seed, fmt::format("mating trial {}", number));
    exec::MatingSetting setting{
        .mating = assemble_.mating, .hold = assemble_.hold, .X_HeldTip = geometry_.X_HeldTip};
    const double most = options_.displacement_mm * kMillimetre;
    for (double& d : setting.d) d = random.Uniform(-most, most);
    const double turn = options_.rotation_deg * kDegree;
    for (double& w : setting.w) w = random.Uniform(-turn, turn);
    return setting;
  }

  const PlannedProblem& planned_;
  const plan::Assemble& assemble_;
  const MatingGeometry& geometry_;
  const Options& options_;
  std::unique_ptr<scene::Scene> scene_;
};

std::string TextOf(const char* name, const Tally& tally, int trials) {
  std::string ends;
  for (const auto& [end, count] : tally.ends) ends += fmt::format(", {} {}", end, count);
  return fmt::format("{}: {} of {} seated{}; at most {:.0f} N\n", name, tally.seated, trials, ends,
                     tally.greatest_force);
}

Json ToJson(const Tally& tally) {
  return {{"seated", tally.seated},
          {"ends", tally.ends},
          {"failures", tally.failures},
          {"force", tally.greatest_force}};
}

// --- The verb.

ExitCode Execute(const Options& options) {
  const PlannedProblem planned = MakePlan(options.scenario, options.models, {}, {});
  const plan::Assemble& assemble = AssembleOf(planned);
  const MatingGeometry geometry =
      finemotion::GeometryOf(planned.problem, planned.problem.mating(assemble.mating));
  finemotion::FineMotionErrors errors;
  errors.pose.head<3>().setConstant(options.displacement_mm * kMillimetre);
  errors.pose.tail<3>().setConstant(options.rotation_deg * kDegree);
  const Stopwatch stopwatch;
  const FineMotionPlan plan =
      finemotion::SearchStrategy(geometry.passage, errors, {.seed = options.seed});
  Json critical_points = Json::array();
  for (const auto& point : geometry.critical_points) critical_points.push_back(point.travel);
  Json json = {{"outcome", plan.found ? "plan" : "none"},
               {"critical_points", critical_points},
               {"absorbed", plan.absorbed},
               {"strategy", ToJson(plan)},
               {"seconds", stopwatch.Seconds()}};
  std::string text = fmt::format(
      "{} critical points; {} motions, certain for {:.2f} times the errors\n{}",
      geometry.critical_points.size(), plan.motions.size(), plan.absorbed, TextOf(plan));
  if (!plan.found) {
    text += fmt::format("no strategy absorbs the errors{}\n",
                        plan.obstacle ? "; in the way: " + TextOf(*plan.obstacle) : "");
    if (plan.obstacle) json["obstacle"] = TextOf(*plan.obstacle);
  }
  if (options.trials > 0 && !plan.motions.empty()) {
    const Progress progress("mating in physics");
    const MatingTrials trials(planned, assemble, geometry, options);
    const plan::Strategy strategy = finemotion::StrategyOf(geometry, plan);
    const Tally with = trials.Run(&strategy);
    const Tally straight = trials.Run(nullptr);
    text += TextOf("strategy", with, options.trials);
    for (const std::string& failure : with.failures) text += fmt::format("  {}\n", failure);
    text += TextOf("straight", straight, options.trials);
    json["trials"] = {
        {"number", options.trials}, {"strategy", ToJson(with)}, {"straight", ToJson(straight)}};
  }
  Print(options.json ? json.dump(2) + "\n" : text);
  return plan.found ? ExitCode::kDone : ExitCode::kNoPlan;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("scenario", options->scenario, "scenario file with an assembled goal")
      ->required();
  command
      .add_option("--displacement", options->displacement_mm,
                  "of the part in the hand at first: so many mm at most, in x, y and z")
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str();
  command
      .add_option("--rotation", options->rotation_deg, "so many degrees at most, about x, y and z")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command
      .add_option("--trials", options->trials, "execute it so often, and a straight line beside it")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  command.add_option("--jobs", options->jobs, "how many threads")->check(CLI::Range(1, 1024));
  command.add_option("--seed", options->seed, "of all that is random")->capture_default_str();
  command
      .add_option("--grasp", options->grasp,
                  "how the gripper holds parts: friction or weld (the default)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, scene::GraspMode>{
          {"friction", scene::GraspMode::kFriction}, {"weld", scene::GraspMode::kWeld}}));
  command.add_flag("--json", options->json, "print the result as JSON");
  command.add_option("--models", options->models, "folder with parts/ and workcells/")
      ->check(CLI::ExistingDirectory);
  return [options] { return Execute(*options); };
}

}  // namespace

const Verb kMate = {
    .name = "mate",
    .summary = "plans the fine motion of one mating, and tries it in physics",
    .example = "assay mate scenarios/mate-square.yaml --trials 20",
    .declare = Declare,
};

}  // namespace assay::cli
