#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "planner/base/counted.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/check/falsification/conservatism.h"
#include "sim/check/falsification/falsification.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/plan_output/certificate_text.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/runs/noisy_run.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/trial_output/json_number.h"
#include "sim/cli/trial_output/verdict_tally.h"
#include "sim/sweep/shell_commands/shell.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kPerhapsSimpler[] =
    "  (the search for fewer and smaller errors was cut short; these are the fewest found so "
    "far)\n";

class FalsificationReport {
 public:
  explicit FalsificationReport(const FalsificationRun& run)
      : run_(run),
        plan_(run.planned.result.plan),
        experiment_{run.planned.problem, plan_, run.planned.simulation.scene},
        tally_(plan_) {}

  ExitCode Execute() {
    const Interruption interruption;
    check::FalsificationOptions options = {
        .attempts = run_.attempts, .seed = run_.seed, .jobs = run_.jobs};
    options.progress = [&](std::int64_t made) {
      progress_->Tell({made, run_.attempts, "attempts"});
      if (made == run_.attempts) progress_->Tell("reducing what was violated to fewer errors");
    };
    options.stop = Interruption::Requested;
    TakeNoiseFloor(experiment_);
    result_ = check::Falsify(experiment_, options);
    if (run_.conservatism && result_.noiseless.Holds()) {
      progress_->Tell("measuring conservatism");
      ratios_ = check::Conservatism(
          experiment_, {.seed = run_.seed, .jobs = run_.jobs, .stop = Interruption::Requested});
    }
    progress_.reset();
    for (std::size_t i = 0; i < result_.certificates.size(); ++i) {
      tally_.Add(plan::StepId(i), result_.certificates[i]);
    }
    tally_.AddClaims(result_.claims);
    for (const check::WorstClaim& worst : result_.worst) tally_.AddWorst(worst.claim);
    const Json result = Result();
    Json printed = result;
    printed["seconds"] = stopwatch_.Seconds();
    PrintAndWrite(run_.json ? plan::JsonText(printed) : Report(), [&] {
      if (!run_.folder.empty()) WriteFile(run_.folder / "result.json", plan::JsonText(result));
    });
    const bool holds = result_.noiseless.Holds() && result_.attempts > 0 &&
                       tally_.Total().violated == 0 &&
                       std::ranges::none_of(ratios_, &check::ConservatismRatio::IsFalse);
    return Interruption::CodeOr(holds ? ExitCode::kDone : ExitCode::kFailed);
  }

 private:
  std::string ReplayCommand(const noise::Noise& noise) const {
    return run_.command.WithErrors(noise::Text(noise)).Text();
  }

  // Returns the command that shows a counterexample in three dimensions.
  std::string ViewCommand(int number) const {
    sweep::CommandLine line("view", run_.folder / "result.json");
    return fmt::format("{} {} -o counterexample-{}.html", line.text(), number, number);
  }

  Json Result() const {
    Json result = {{"attempts", result_.attempts},
                   {"verdicts", tally_.ToJson()},
                   {"claims", tally_.ClaimsToJson()},
                   {"failed_approaches", result_.failed_approaches},
                   {"not_attempted", Json::array()},
                   {"without_noise", ToJson(plan_, result_.noiseless)},
                   {"worst", Json::array()},
                   {"counterexamples", Json::array()},
                   {"replay", Json::array()},
                   {"scenario", run_.planned.scenario},
                   {"seed", run_.seed},
                   {"grasp", scene::Name(run_.planned.simulation.scene.grasp)},
                   {"noise", "attack"},
                   {"gate", ToJson(plan_, experiment_.gate)}};
    if (Interruption::Requested()) result["interrupted"] = true;
    for (const plan::StepId id : StepsNotAttempted()) {
      result["not_attempted"].push_back(plan_.step(id).name);
    }
    for (const check::WorstClaim& worst : result_.worst) {
      Json row = ToJson(plan_, worst.claim);
      row["phase"] = check::Name(worst.phase);
      row["attempt"] = worst.attempt;
      row["noise"] = noise::Text(worst.noise);
      result["worst"].push_back(std::move(row));
    }
    for (const check::Counterexample& example : result_.counterexamples) {
      Json row = ToJson(plan_, example.claim);
      row["steps"] = example.steps;
      row["replayed"] = example.replayed;
      row["simplest"] = example.is_simplest;
      row["noise"] = noise::Text(example.noise);
      row["replay"] = ReplayCommand(example.noise);
      result["counterexamples"].push_back(row);
      result["replay"].push_back(row["replay"]);
    }
    if (run_.conservatism) {
      result["conservatism"] = Json::array();
      for (const check::ConservatismRatio& ratio : ratios_) {
        result["conservatism"].push_back({{"variable", ratio.variable},
                                          {"guaranteed", ratio.guaranteed},
                                          {"broken", OrNull(ratio.broken)},
                                          {"ratio", OrNull(ratio.ratio())}});
      }
    }
    return result;
  }

  std::string Counterexamples() const {
    std::string text;
    int number = 0;
    for (const check::Counterexample& example : result_.counterexamples) {
      text += fmt::format("\nviolated: step {}: {}\n  {}\nto repeat it: {}\n", example.steps,
                          Text(example.claim), noise::Text(example.noise),
                          ReplayCommand(example.noise));
      ++number;
      if (!run_.folder.empty()) text += "to see it: " + ViewCommand(number) + "\n";
      if (!example.replayed) text += "  (seen only in an execution from a saved state)\n";
      if (example.replayed && !example.is_simplest) text += kPerhapsSimpler;
    }
    return text;
  }

  std::vector<plan::StepId> StepsNotAttempted() const {
    std::vector<plan::StepId> steps = plan_.ExecutionOrder();
    std::erase_if(steps, [&](plan::StepId id) { return result_.attempts_at[id.index()] > 0; });
    return steps;
  }

  std::string NotAttempted() const {
    const std::vector<plan::StepId> steps = StepsNotAttempted();
    if (steps.empty()) return "";
    return fmt::format("no attempt was made at {}, so nothing is known about {}\n",
                       StepsText(plan_, steps), steps.size() == 1 ? "it" : "them");
  }

  std::string Outcome(std::int64_t violated) const {
    if (result_.attempts == 0) return "no attempt was made, so nothing is known about the plan\n";
    if (violated == 0) {
      return fmt::format("not falsified in {}\n", Counted(result_.attempts, "attempt")) +
             NotAttempted();
    }
    return fmt::format("violated in {} of {} attempts\n", violated, result_.attempts);
  }

  // Returns the steps with many inconclusive attempts. For them, "not falsified" means little.
  std::string HardlyTested() const {
    constexpr double kOften = 0.05;  // share of a step's attempts
    std::string text;
    for (const plan::StepId id : plan_.ExecutionOrder()) {
      const check::VerdictCounts& counts = result_.certificates[id.index()];
      const auto all = static_cast<double>(counts.Total());
      const auto inconclusive = static_cast<double>(counts.inconclusive);
      if (inconclusive <= kOften * all) continue;
      text += fmt::format(
          "{} of the {} attempts on step {} ({:.0f} %) are inconclusive: the observation was "
          "outside of its prediction by no more than the gate, or the violation was not "
          "confirmed\n",
          counts.inconclusive, counts.Total(), plan_.step(id).executed, 100 * inconclusive / all);
    }
    return text;
  }

  std::string Ratios() const {
    if (!run_.conservatism) return {};
    Table table({{"variable"},
                 {"guaranteed", Align::kRight},
                 {"broken", Align::kRight},
                 {"ratio", Align::kRight}});
    const auto number = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.2f}", *value) : std::string("-");
    };
    for (const check::ConservatismRatio& ratio : ratios_) {
      table.Add({ratio.variable, fmt::format("{:.2f}", ratio.guaranteed), number(ratio.broken),
                 number(ratio.ratio())});
    }
    std::string text =
        "\nmultiples of the errors: the greatest with guaranteed success, and the least with a "
        "failed trial\n" +
        table.Text();
    for (const check::ConservatismRatio& ratio : ratios_) {
      if (!ratio.IsFalse()) continue;
      text += fmt::format("{}: a trial failed within the guaranteed bound\n", ratio.variable);
    }
    return text;
  }

  std::string Report() const {
    const check::VerdictCounts total = tally_.Total();
    std::string text = "noise floors of the claims\n";
    text += Text(plan_, experiment_.gate) + "\n" + tally_.Text(run_.planned.problem) +
            Counterexamples();
    text += Ratios();
    if (result_.failed_approaches > 0) {
      text += fmt::format("\nin {} trials the arm did not reach the start of the next step\n",
                          result_.failed_approaches);
    }
    if (!result_.noiseless.Holds()) return text + Text(plan_, result_.noiseless, experiment_.gate);
    text += "\n" + Outcome(total.violated) + HardlyTested();
    text += Interruption::Text(result_.attempts, run_.attempts, "attempts were made");
    if (Interruption::Requested() && run_.conservatism) {
      text += fmt::format("conservatism was measured for {} variables\n", ratios_.size());
    }
    text += NotCoveredText(run_.planned.problem, plan_);
    if (!run_.folder.empty()) text += fmt::format("files in {}\n", run_.folder.string());
    return text;
  }

  const FalsificationRun& run_;
  const plan::Plan& plan_;
  const Stopwatch stopwatch_;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>("attacking");
  check::Experiment experiment_;
  check::FalsificationResult result_;
  std::vector<check::ConservatismRatio> ratios_;
  VerdictTally tally_;
};

}  // namespace

ExitCode RunFalsification(const FalsificationRun& run) {
  return FalsificationReport(run).Execute();
}

}  // namespace assay::cli
