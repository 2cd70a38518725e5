#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/finemotion/strategy_search/mating.h"
#include "sim/check/contact_sequences/contact_observer.h"
#include "sim/check/contact_sequences/sequence_comparison.h"
#include "sim/cli/tasks/mating_task.h"
#include "sim/execution/trial/mating_trial.h"

namespace assay::cli {

// The contacts of a trial, compared with the planned ones.
struct SequenceRecord {
  check::ObservedContacts contacts;
  std::vector<check::ObservedState> states;
  check::SequenceComparison comparison;
};

// One trial of a mating.
struct MatedTrial {
  int number = 0;  // from 1
  // The greatest of the trial's errors, as a multiple of the half widths that were planned for.
  double scale = 0;
  // Number of earlier draws for this trial that were rejected, because no trial can begin with
  // their errors.
  int redrawn = 0;
  execution::MatingResult result;
  bool seated = false;  // a success (execution::MatingFindings); if not, result.end has a reason
  std::optional<SequenceRecord> sequence = {};  // only with a strategy
};

// Settings that all trials of a mating share.
struct MatingTrialSettings {
  finemotion::FineMotionErrors errors;  // the errors that were planned for
  double beyond = 1;                    // trials draw errors from a box this many times as wide
  scene::SceneOptions scene = {};
  std::uint64_t seed = 1;
  kinematics::JointVector near;  // execution::MatingSetting::near
};

// Executes one mating repeatedly in one scene. Errors are drawn from the seed and the trial's
// number alone. Errors with which the strategy cannot start (execution::CanStart) are drawn anew.
// All arguments of the constructor must outlive the object.
class MatingTrials {
 public:
  MatingTrials(const MatingTask& task, const finemotion::MatingGeometry& geometry,
               const plan::Strategy& strategy, const MatingTrialSettings& settings);

  // Both throw Stopped as soon as a stop is requested (planner/base/stop.h). `sample_rate` is that
  // of execution::ExecutorOptions.
  MatedTrial RunStrategy(int number, const check::PlannedContacts& contacts,
                         double sample_rate = 0) const;
  MatedTrial RunStraight(int number, double sample_rate = 0) const;

 private:
  struct Drawn {
    execution::MatingSetting setting;
    int redrawn = 0;
  };
  Drawn DrawnFor(int number) const;
  MatedTrial Recorded(int number, const Drawn& drawn, execution::MatingResult result) const;

  const domain::Problem& problem_;
  const plan::Action& assemble_;
  const finemotion::MatingGeometry& geometry_;
  const plan::Strategy& strategy_;
  const MatingTrialSettings& settings_;
  scene::Scene scene_;
};

}  // namespace assay::cli
