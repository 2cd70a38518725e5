#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/falsification/falsification.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/python/planning.h"
#include "sim/python/traced_trial.h"
#include "sim/sweep/database/store.h"

namespace assay::python {

// What happens in the trials of a plan.
struct TrialSettings {
  std::optional<std::string> noise = {};   // the name of a noise::Mode; none: no noise
  std::optional<std::string> errors = {};  // as noise::Text writes them, instead of a mode
  std::string sensing = "drawn";           // or "camera"
  std::optional<std::string> grasp = {};   // "friction" or "weld"; none: the scenario's
  std::optional<std::uint64_t> seed = {};  // none: the scenario's
};

// The result of a falsification.
struct MadeFalsification {
  sweep::TimedTrial record;
  // What is wrong with the plan without noise. If this is not empty, nothing was attempted.
  std::string untestable;
};

// A plan that is executed repeatedly.
class Trials {
 public:
  // Measures the noise floor if there is noise, or if `is_falsification`. Throws Refused if the
  // plan has flaws, and UsageError or InputError for wrong settings.
  Trials(std::shared_ptr<const PlanHandle> plan, const TrialSettings& settings,
         bool is_falsification);

  std::uint64_t seed() const { return seed_; }
  // Returns what is wrong with the plan without noise. If this is not empty, trials under noise
  // prove nothing.
  std::string WrongWithoutNoise() const;
  // Executes the trials 1 to `count`. If a stop is requested, returns only the finished trials. The
  // result does not depend on the number of jobs.
  std::vector<sweep::TimedTrial> Run(int count, int jobs) const;
  // Executes one trial and keeps its trace. The numbers of trials count from 1.
  std::shared_ptr<const TracedTrial> Traced(int number) const;
  // Tries to falsify the plan. If a stop is requested, the result has only the attempts that were
  // made until then.
  MadeFalsification Falsify(std::int64_t attempts, int jobs) const;

 private:
  bool HasNoise() const { return settings_.noise || settings_.errors; }
  noise::Noise NoiseOf(int number) const;
  check::Trial One(int number, bool with_samples) const;

  const std::shared_ptr<const PlanHandle> plan_;
  const TrialSettings settings_;
  const std::uint64_t seed_;
  const std::vector<noise::Channel> box_;
  const scene::SceneOptions scene_options_;
  const check::Experiment experiment_;
  const std::optional<scene::Scene> scene_;  // shared by trials without noise
};

// The bounded errors that the plan's proofs assume: name, dimension and range of each.
nlohmann::ordered_json ErrorBoxOf(const PlanHandle& plan);

// Return records as rows of tables, with numbers in SI units.
nlohmann::ordered_json ToJson(const sweep::TimedTrial& timed);
nlohmann::ordered_json ToJson(const sweep::FalsificationRecord& falsification);

}  // namespace assay::python
