#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "sim/check/falsification/falsification_result.h"
#include "sim/check/falsification/step_falsification.h"

namespace assay::check {

using ClaimKey = std::tuple<plan::StepId, Claimed, std::string>;
ClaimKey KeyOf(const Claim& claim);

// An attempt at a step: its start, its errors, how far it goes, and its result.
struct Sample {
  std::size_t start = 0;      // index of a poised trial
  std::vector<double> point;  // in the unit cube of the free channels
  FalsificationPhase phase = FalsificationPhase::kVertices;
  Until until = Until::kEnd;
  StepAttempt attempt = {};
  bool was_made = false;  // false if the falsification was stopped before it
};

// The purpose of an attempt: a claim, and the stage by which it is decided.
struct Aim {
  ClaimKey claim;
  Until until = Until::kEnd;
  double seconds = 0;  // simulated time up to that stage
};

// Divides attempts among aims so that all aims get the same simulated time. Claims that are decided
// sooner are attempted more often.
std::vector<std::int64_t> Allotted(std::int64_t attempts, const std::vector<Aim>& aims);

// A step under falsification. It holds the trials that are poised for the step, all samples of the
// step in order, and the aims of the attempts.
class TriedStep {
 public:
  TriedStep(const Experiment& experiment, plan::StepId id, const noise::Noise& noise);

  const StepFalsification& falsification() const { return falsification_; }
  int dimensions() const { return static_cast<int>(ranges_.size()); }
  std::vector<PoisedTrial>& poised() { return poised_; }
  std::vector<Sample>& samples() { return samples_; }
  const std::vector<Aim>& aims() const { return aims_; }

  // Makes the attempt. If it ends before the step does, only claims that are decided by then are
  // kept.
  StepAttempt Attempt(const Sample& sample) const;

  // Sets an aim for each claim that errors can change. The aim ends at the stage at which all
  // samples so far had decided the claim.
  void FindAims();
  // Returns the aim for the claim, or null if there is none.
  const Aim* AimAt(const ClaimKey& claim) const;

 private:
  std::vector<double> At(const std::vector<double>& point) const;

  StepFalsification falsification_;
  std::vector<Interval> ranges_;
  std::vector<PoisedTrial> poised_;
  std::vector<Sample> samples_;
  std::vector<Aim> aims_;
};

}  // namespace assay::check
