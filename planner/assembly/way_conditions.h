#pragma once

#include <string_view>
#include <vector>

#include "planner/motion/clear/sway.h"
#include "planner/plan/data/certificate.h"

namespace assay::assembly {

// What is certain of the arm's way to a step's work and of the straight lines of its work, whatever
// the errors are.
struct WayCertainty {
  motion::Sway sway;
  double kept = 0;  // by bodies from each other, metres; 0: they are not known to keep clear

  bool Reaches() const { return sway.is_bounded && sway.room > 0; }
};

enum class Whither { kWork, kHome };

// The preconditions of a step that are about the arm (sound mode), as far as they are proved; where
// one is not there, plan::NotCovered says so.
//   reach      the arm comes to all that errors may ask of it, in the configuration in which it is
//              planned and within its joints' ranges (motion::SwayAlong)
//   way clear  arm, hand and what it holds stay clear of everything on the way, and the arm on the
//              straight lines of the work, wherever parts and joints are within their errors
std::vector<plan::CertifiedPrecondition> WayConditions(const WayCertainty& certainty,
                                                       Whither whither);
bool IsWayCondition(std::string_view condition);
// Takes from a certificate what it says of ways, and also that it does not.
void RemoveWayConditions(plan::Certificate& certificate);
Whither WhitherOf(const plan::CertifiedPrecondition& way_condition);

}  // namespace assay::assembly
