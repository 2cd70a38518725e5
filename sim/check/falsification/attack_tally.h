#pragma once

#include <vector>

#include "sim/check/falsification/attacked_step.h"

namespace assay::check {

// Counts the verdicts of a falsification, and keeps the worst result of each claim.
class AttackTally {
 public:
  // Keeps a reference to the result, whose certificates must be one for each step.
  explicit AttackTally(AttackResult& result) : result_(result) {}

  void Count(const Sample& sample);  // an attempt at a step
  void Count(const std::vector<Claim>& claims, const noise::Noise& noise, AttackPhase phase);

 private:
  void KeepIfWorst(const Claim& claim, const noise::Noise& noise, AttackPhase phase);

  AttackResult& result_;
};

}  // namespace assay::check
