#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/interval.h"
#include "planner/plan/data/plan.h"
#include "sim/check/claims/unit.h"

namespace assay::check {

// How a claim of a certificate came out in one trial.
enum class ClaimVerdict {
  kContained,     // what was observed is where the certificate says
  kInconclusive,  // outside, but by less than the engine can tell from nothing
  kViolated,      // outside by more than that
  kNotClaimed,    // an assumption that the certificate had left unproved did not hold
};
std::string_view Name(ClaimVerdict verdict);  // "not-claimed"

// 0 for the worst, kViolated, and then in the order violated, inconclusive, contained, not claimed.
int Rank(ClaimVerdict verdict);

// What a claim is about.
enum class Claimed {
  kBefore,        // a component of an input error set
  kPrecondition,  // by how much the geometric meaning of a precondition holds
  kAfter,         // a component of an output error set
};
std::string_view Name(Claimed claimed);  // "before", "precondition", "after"

// One thing that a certificate says, and what was observed of it.
struct Claim {
  plan::StepId step;
  Claimed about = Claimed::kAfter;
  std::string name;  // "x of block", "between fingers: contact 1 of block"
  Unit unit = Unit::kNone;
  // That the observed value lies in: what the certificate says, and what is known of the engine
  // (HonestyGate). An end may be infinite.
  Interval predicted;
  bool proved = true;  // false: a precondition that the planner could not prove
  double observed = 0;
  double margin = 0;  // to the nearer end; negative: outside
  double gate = 0;    // what the engine cannot tell from 0, in the same unit
  ClaimVerdict verdict = ClaimVerdict::kContained;

  bool IsViolated() const { return verdict == ClaimVerdict::kViolated; }
};

// The verdict on what was observed: violated beyond the gate, inconclusive within it.
Claim Judged(Claim claim);

// Whether both are about the same.
bool IsSame(const Claim& a, const Claim& b);

// How many came out how.
struct VerdictCounts {
  std::int64_t contained = 0, inconclusive = 0, violated = 0, not_claimed = 0;

  void Add(ClaimVerdict verdict);
  VerdictCounts& operator+=(const VerdictCounts& other);
  bool operator==(const VerdictCounts&) const = default;

  std::int64_t Of(ClaimVerdict verdict) const;
  std::int64_t Total() const { return contained + inconclusive + violated + not_claimed; }
};

// Whether a is worse than b: by verdict, then by margin (AsLength).
bool IsWorse(const Claim& a, const Claim& b);

// Of all claims about one step the worst.
struct CertificateVerdict {
  plan::StepId step;
  ClaimVerdict verdict = ClaimVerdict::kNotClaimed;
  Claim worst;
};
std::vector<CertificateVerdict> ByStep(const std::vector<Claim>& claims);

}  // namespace assay::check
