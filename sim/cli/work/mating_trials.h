#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/finemotion/contacts/mating.h"
#include "sim/check/contacts/contact_observer.h"
#include "sim/check/contacts/sequence_comparison.h"
#include "sim/cli/work/mating_task.h"
#include "sim/exec/control/mating_trial.h"

namespace assay::cli {

// What touched in a trial, against what was planned.
struct SequenceRecord {
  check::ObservedContacts contacts;
  std::vector<check::ObservedState> states;
  check::SequenceComparison comparison;
};

// One trial of a mating.
struct MatedTrial {
  int number = 0;    // from 1
  double scale = 0;  // of the greatest of its errors, in half widths of those planned for
  int redrawn = 0;   // how often errors were drawn before with which no trial can begin
  exec::MatingResult result;
  bool seated = false;
  std::optional<SequenceRecord> sequence = {};  // of a strategy
};

struct MatingTrialSettings {
  finemotion::FineMotionErrors errors;  // that were planned for
  double beyond = 1;                    // trials draw theirs from so many times as wide a box
  scene::SceneOptions scene = {};
  std::uint64_t seed = 1;
  kinematics::JointVector near;  // exec::MatingSetting::near
};

// Executes one mating again and again in one scene, with errors drawn from the seed and the
// trial's number alone. Errors with which the strategy cannot start (exec::CanStart) are drawn
// anew. All that it is given must outlive it.
class MatingTrials {
 public:
  MatingTrials(const MatingTask& task, const finemotion::MatingGeometry& geometry,
               const plan::Strategy& strategy, const MatingTrialSettings& settings);

  // Throws BrokenOff as soon as an interruption is requested (interruption.h).
  MatedTrial RunStrategy(int number, const check::PlannedContacts& contacts) const;
  MatedTrial RunStraight(int number) const;

 private:
  struct Drawn {
    exec::MatingSetting setting;
    int redrawn = 0;
  };
  Drawn DrawnFor(int number) const;
  MatedTrial Told(int number, const Drawn& drawn, exec::MatingResult result) const;

  const domain::Problem& problem_;
  const plan::Assemble& assemble_;
  const finemotion::MatingGeometry& geometry_;
  const plan::Strategy& strategy_;
  const MatingTrialSettings& settings_;
  scene::Scene scene_;
};

}  // namespace assay::cli
