#include "tests/sim/check/mutation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/falsification/falsification.h"
#include "sim/check/falsification/main_effects.h"
#include "sim/check/noise_floor/confirmation.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/execution/walk/executor.h"
#include "sim/noise/sampling.h"

namespace assay::check::mutation_test {
namespace {

constexpr std::uint64_t kSeed = 11;

Experiment Of(const Certified& certified, const NoiseFloor& gate) {
  return {certified.problem, certified.plan, {}, gate};
}

// Executes the whole plan at corners of the error box, and at the corners where these executions
// suggest that claims are extreme. This tells which mutants a true error reveals, without any
// falsification.
class TrueErrors {
 public:
  TrueErrors(const Experiment& experiment, int corners)
      : experiment_(experiment), box_(noise::ErrorBox(experiment.problem, experiment.plan)) {
    const int errors = static_cast<int>(box_.size());
    for (int n = 1; n <= corners; ++n) design_.push_back(noise::CornerPoint(errors, kSeed + 1, n));
    for (const std::vector<double>& corner : design_) trials_.push_back(ExecutedAt(corner));
    for (const std::vector<double>& corner : LikelyCorners()) {
      trials_.push_back(ExecutedAt(corner));
    }
  }

  // Returns whether a trial violates the mutant and half the timestep confirms it. Falsification
  // uses the same criterion.
  bool Reveal(const plan::Plan& mutant) {
    return std::ranges::any_of(trials_, [&](Trial& trial) {
      const auto finer = [&] { return ClaimsOf(mutant, WithHalfTheTimestep(trial)); };
      return std::ranges::any_of(Confirmed(ClaimsOf(mutant, trial.trace), finer),
                                 &Claim::IsViolated);
    });
  }

 private:
  struct Trial {
    noise::Noise noise;
    execution::Trace trace;
    std::optional<execution::Trace> finer = {};  // made on demand
  };

  std::vector<Claim> ClaimsOf(const plan::Plan& plan, const execution::Trace& trace) const {
    return CheckCertificates(experiment_.problem, plan, trace, experiment_.gate);
  }

  Trial ExecutedAt(const std::vector<double>& corner) const {
    std::vector<double> values(box_.size());
    for (std::size_t i = 0; i < box_.size(); ++i) {
      values[i] = corner[i] > 0 ? box_[i].range.high : box_[i].range.low;
    }
    Trial trial{.noise = {box_, std::move(values)}, .trace = {}};
    trial.trace = Executed(trial.noise, experiment_.scene);
    return trial;
  }

  execution::Trace Executed(const noise::Noise& noise, const scene::SceneOptions& options) const {
    execution::ExecutorOptions executor;
    executor.noise = noise;
    executor.sample_rate = 0;
    executor.recovers = false;
    const scene::Scene scene(experiment_.problem, execution::TrueScene(options, noise));
    mujoco::Data data = execution::StartOf(experiment_.problem, scene, noise);
    return execution::Execute(experiment_.problem, experiment_.plan, scene, data, executor);
  }

  const execution::Trace& WithHalfTheTimestep(Trial& trial) const {
    if (!trial.finer) trial.finer = Executed(trial.noise, Finer(experiment_.scene));
    return *trial.finer;
  }

  std::set<std::vector<double>> LikelyCorners() const {
    std::map<std::tuple<plan::StepId, Claimed, std::string>, std::vector<CornerResponse>> responses;
    for (std::size_t n = 0; n < design_.size(); ++n) {
      for (const Claim& claim : ClaimsOf(experiment_.plan, trials_[n].trace)) {
        responses[{claim.step, claim.about, claim.name}].push_back(
            {&design_[n], 0, claim.observed});
      }
    }
    std::set<std::vector<double>> corners;
    for (const auto& [name, of_claim] : responses) {
      if (of_claim.size() != design_.size()) continue;
      const LikelyExtremes extremes = ByMainEffects(of_claim);
      corners.insert(extremes.least.corner);
      corners.insert(extremes.greatest.corner);
    }
    return corners;
  }

  const Experiment& experiment_;
  std::vector<noise::Channel> box_;
  std::vector<std::vector<double>> design_;
  std::vector<Trial> trials_;
};

// The counts for one kind of lie.
struct Score {
  int mutants = 0;
  int revealable = 0;
  // For each mutant that was found, the number of the attempt that found it.
  std::vector<std::int64_t> found = {};
  std::string missed = {};

  Score& operator+=(const Score& other) {
    mutants += other.mutants;
    revealable += other.revealable;
    found.insert(found.end(), other.found.begin(), other.found.end());
    missed += other.missed;
    return *this;
  }
};
using Scores = std::map<Lie, Score>;

std::optional<std::int64_t> AttemptThatFinds(const plan::Plan& mutant, const Experiment& original,
                                             std::int64_t attempts) {
  const Experiment experiment = {original.problem, mutant, original.scene, original.gate};
  return Falsify(experiment,
                 {.attempts = attempts, .seed = kSeed, .until_violated = true, .shrunk = 0})
      .first_violation;
}

// The effort of the test.
struct Effort {
  int corners = 32;             // of whole executions, before those at the likely corners
  std::int64_t attempts = 200;  // for each mutant
  std::size_t stride = 1;       // every stride-th mutant is tried
};

Scores ScoresOf(const Certified& certified, const Effort& effort) {
  const NoiseFloor gate = MeasureNoiseFloor(certified.problem, certified.plan, {});
  const Experiment experiment = Of(certified, gate);
  TrueErrors errors(experiment, effort.corners);
  EXPECT_FALSE(errors.Reveal(certified.plan)) << "the theory itself lies";
  Scores scores;
  const std::vector<Mutation> mutations = MutationsOf(certified);
  for (std::size_t i = 0; i < mutations.size(); i += effort.stride) {
    const Mutation& mutation = mutations[i];
    Score& score = scores[mutation.lie];
    const plan::Plan mutant = CertifiedWith(mutation, certified);
    ++score.mutants;
    if (!errors.Reveal(mutant)) continue;
    ++score.revealable;
    const auto attempt = AttemptThatFinds(mutant, experiment, effort.attempts);
    if (attempt) {
      score.found.push_back(*attempt);
    } else {
      score.missed += "  " + mutation.Text(certified) + "\n";
    }
  }
  return scores;
}

Score Total(const Scores& scores) {
  Score total;
  for (const auto& [lie, score] : scores) total += score;
  return total;
}

// Returns the median. It is the smaller of the two middle numbers if their count is even.
std::int64_t Median(std::vector<std::int64_t> numbers) {
  if (numbers.empty()) return 0;
  std::ranges::sort(numbers);
  return numbers[(numbers.size() - 1) / 2];
}

std::string Table(const std::string& title, const Scores& scores) {
  std::string text = fmt::format("{}\n{:28} {:>8} {:>11} {:>6} {:>16} {:>9}\n", title, "lie",
                                 "mutants", "revealable", "found", "median attempt", "greatest");
  const auto row = [](std::string_view name, const Score& score) {
    const std::int64_t greatest = score.found.empty() ? 0 : std::ranges::max(score.found);
    return fmt::format("{:28} {:8} {:11} {:6} {:16} {:9}\n{}", name, score.mutants,
                       score.revealable, score.found.size(), Median(score.found), greatest,
                       score.missed);
  };
  for (const auto& [lie, score] : scores) text += row(Name(lie), score);
  return text + row("all", Total(scores));
}

// The theory without a lie makes the same certificates as the planner.
TEST(Mutation, WithoutALieNothingChanges) {
  const Certified certified = CertifiedPlan("uncertain-known");
  const plan::Plan again = CertifiedWith({.lie = Lie::kHalvedSet}, certified);
  for (std::size_t i = 0; i < again.steps.size(); ++i) {
    EXPECT_EQ(again.steps[i].certificate.before, certified.plan.steps[i].certificate.before);
    EXPECT_EQ(again.steps[i].certificate.after, certified.plan.steps[i].certificate.after);
  }
}

TEST(Mutation, EachLieChangesWhatIsCertified) {
  const Certified certified = CertifiedPlan("uncertain-known");
  const auto changed = [&](const plan::Plan& mutant) {
    for (std::size_t i = 0; i < mutant.steps.size(); ++i) {
      const plan::Certificate& lied = mutant.steps[i].certificate;
      const plan::Certificate& true_one = certified.plan.steps[i].certificate;
      if (lied.before != true_one.before || lied.after != true_one.after) return true;
    }
    return false;
  };
  for (const Mutation& mutation : MutationsOf(certified)) {
    // The other lies may change nothing. For example, what is forgotten about a part is known again
    // after the part has come into its seat.
    if (mutation.lie != Lie::kHalvedSet && mutation.lie != Lie::kForgottenError) continue;
    EXPECT_TRUE(changed(CertifiedWith(mutation, certified))) << mutation.Text(certified);
  }
}

// Returns whether the scenario has exactly one plan. It may also have a plan tree or no plan.
bool HasPlan(const std::string& scenario) {
  const domain::Problem problem = ScenarioNamed(scenario);
  if (problem.goals.empty() || !problem.open_poses.empty()) return false;
  return !CertifiedPlan(problem).plan.steps.empty();
}

// Returns the scenarios that `asked` names, separated by spaces. "all" means every shipped scenario
// that has a plan.
std::vector<std::string> Scenarios(const std::string& asked) {
  std::istringstream words(asked);
  std::vector<std::string> names{std::istream_iterator<std::string>(words), {}};
  if (asked != "all") return names;
  names.clear();
  const std::filesystem::path folder = ASSAY_SOURCE_DIR "/scenarios";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    if (HasPlan(entry.path().stem())) names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

// The harness must find the lies that true errors reveal. The variable ASSAY_MUTANTS names
// scenarios, separated by spaces, or "all". Every mutant of them is tried with 200 attempts, which
// takes hours. ASSAY_MUTANTS_STRIDE=N tries every N-th mutant only. Without ASSAY_MUTANTS, some
// mutants of one pickup are tried with few attempts.
TEST(Harness, FindsLiesThatTrueErrorsReveal) {
  const char* const asked = std::getenv("ASSAY_MUTANTS");
  const char* const stride = std::getenv("ASSAY_MUTANTS_STRIDE");
  const Effort full = {.stride = stride == nullptr ? 1 : std::stoul(stride)};
  Scores scores;
  if (asked == nullptr) {
    Certified certified = CertifiedPlan("uncertain-known");
    certified.plan = UpToThePickup(certified.plan);
    scores = ScoresOf(certified, {.corners = 8, .attempts = 16, .stride = 3});
    fmt::print("{}", Table("pickup of uncertain-known", scores));
    EXPECT_GE(Total(scores).revealable, 2);
  } else {
    for (const std::string& name : Scenarios(asked)) {
      const Scores of_scenario = ScoresOf(CertifiedPlan(name), full);
      fmt::print("{}", Table(name, of_scenario));
      std::fflush(stdout);
      for (const auto& [lie, score] : of_scenario) scores[lie] += score;
    }
  }
  const Score total = Total(scores);
  fmt::print("{}", Table("all scenarios", scores));
  EXPECT_GE(static_cast<double>(total.found.size()), 0.95 * total.revealable)
      << Table("missed", scores);
}

}  // namespace
}  // namespace assay::check::mutation_test
