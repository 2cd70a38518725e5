#pragma once

#include <vector>

#include "sim/check/falsification/tried_step.h"

namespace assay::check {

// Counts the verdicts of a falsification, and keeps the worst result of each claim.
class FalsificationTally {
 public:
  // Keeps a reference to the result, which must have one certificate for each step.
  explicit FalsificationTally(FalsificationResult& result) : result_(result) {}

  void Count(const Sample& sample);  // an attempt at a step
  void Count(const std::vector<Claim>& claims, const noise::Noise& noise, FalsificationPhase phase);

 private:
  void KeepIfWorst(const Claim& claim, const noise::Noise& noise, FalsificationPhase phase);

  FalsificationResult& result_;
};

}  // namespace assay::check
