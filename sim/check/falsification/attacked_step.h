#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "sim/check/falsification/attack_result.h"
#include "sim/check/falsification/step_attack.h"

namespace assay::check {

using ClaimKey = std::tuple<plan::StepId, Claimed, std::string>;
ClaimKey KeyOf(const Claim& claim);

// An attempt at a step: from where, with which errors, how far, and what came of it.
struct Sample {
  std::size_t start = 0;      // index of a poised trial
  std::vector<double> point;  // in the unit cube of the free channels
  AttackPhase phase = AttackPhase::kVertices;
  Until until = Until::kEnd;
  StepAttempt attempt = {};
  bool was_made = false;  // not if the attack was stopped before
};

// What an attempt is made for: a claim, that is decided by then.
struct Aim {
  ClaimKey claim;
  Until until = Until::kEnd;
  double seconds = 0;  // simulated, up to there
};

// Splits attempts so that aims get the same simulated time: what is decided sooner is attempted
// more often.
std::vector<std::int64_t> Allotted(std::int64_t attempts, const std::vector<Aim>& aims);

// A step that is attacked: the trials that are poised for it, all its samples in their order, and
// what it is attempted for.
class AttackedStep {
 public:
  AttackedStep(const Experiment& experiment, plan::StepId id, const noise::Noise& noise);

  const StepAttack& attack() const { return attack_; }
  int dimensions() const { return static_cast<int>(ranges_.size()); }
  std::vector<PoisedTrial>& poised() { return poised_; }
  std::vector<Sample>& samples() { return samples_; }
  const std::vector<Aim>& aims() const { return aims_; }

  // What is made of a step that is broken off counts as far as it is decided.
  StepAttempt Attempt(const Sample& sample) const;

  // Aims at the claims that errors can change; each ends when all samples so far had decided it.
  void FindAims();
  // Null: there is none.
  const Aim* AimAt(const ClaimKey& claim) const;

 private:
  std::vector<double> At(const std::vector<double>& point) const;

  StepAttack attack_;
  std::vector<Interval> ranges_;
  std::vector<PoisedTrial> poised_;
  std::vector<Sample> samples_;
  std::vector<Aim> aims_;
};

}  // namespace assay::check
