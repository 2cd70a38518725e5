#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/interval.h"
#include "planner/plan/data/plan.h"
#include "sim/check/measurements/observed_error.h"

namespace assay::check {

// The verdict on a claim of a certificate in one trial.
enum class ClaimVerdict {
  kContained,     // the observed value is where the certificate says
  kInconclusive,  // outside, but by less than the engine can resolve
  kViolated,      // outside by more than that
  kNotClaimed,    // an assumption that the certificate left unproved did not hold
};
std::string_view Name(ClaimVerdict verdict);  // "not-claimed"

// Returns the place in the order violated, inconclusive, contained, not claimed. The worst,
// kViolated, has rank 0.
int Rank(ClaimVerdict verdict);

// The subject of a claim.
enum class Claimed {
  kBefore,        // a component of an input error set
  kPrecondition,  // the margin by which a precondition's geometric meaning holds
  kAfter,         // a component of an output error set
};
std::string_view Name(Claimed claimed);  // "before", "precondition", "after"

// One statement of a certificate, and the observation of it.
struct Claim {
  plan::StepId step;
  Claimed about = Claimed::kAfter;
  std::string name;  // "x of block", "between fingers: contact 1 of block"
  // Missing for a statement that is either true (1) or false (0), such as that a step comes to its
  // end.
  std::optional<domain::Dimension> dimension = {};
  // The interval that must hold the observed value: the certificate's interval, widened by the
  // known errors of the engine (NoiseFloor). An end may be infinite.
  Interval predicted;
  bool proved = true;  // false: a precondition that the planner could not prove
  double observed = 0;
  Lever lever = {};          // of the point whose position is observed
  bool is_of_fixed = false;  // true for the part with which a mating step mates the held part
  double margin = 0;         // distance to the nearer end; negative outside
  double gate = 0;  // a smaller deviation outside means nothing (NoiseFloor); the claim's unit
  ClaimVerdict verdict = ClaimVerdict::kContained;

  // Returns the SI unit of the claim's numbers, as files name this unit; empty for ratios and
  // statements.
  std::string_view UnitName() const {
    return domain::SiUnitOf(dimension.value_or(domain::Dimension::kRatio)).name;
  }
  bool IsViolated() const { return verdict == ClaimVerdict::kViolated; }
};

// Returns a length by which values of different dimensions are compared. Radians count as the
// length of an arc at a tenth of a metre from the axis. Other values are returned as they are.
double AsLength(double value, std::optional<domain::Dimension> dimension);

// Returns the claim with margin and verdict set from the observed value. A value outside is
// inconclusive within the gate and violated beyond it.
Claim Judged(Claim claim);

// Returns whether both claims are about the same step, subject and name.
bool IsSame(const Claim& a, const Claim& b);

// The number of claims with each verdict.
struct VerdictCounts {
  std::int64_t contained = 0, inconclusive = 0, violated = 0, not_claimed = 0;

  void Add(ClaimVerdict verdict);
  VerdictCounts& operator+=(const VerdictCounts& other);
  bool operator==(const VerdictCounts&) const = default;

  std::int64_t Of(ClaimVerdict verdict) const;
  std::int64_t Total() const { return contained + inconclusive + violated + not_claimed; }
};

// Returns whether `a` is worse than `b`: first by verdict, then by margin (AsLength).
bool IsWorse(const Claim& a, const Claim& b);

// The verdict on one step's certificate. It is the verdict on the certificate's worst claim.
struct CertificateVerdict {
  plan::StepId step;
  ClaimVerdict verdict = ClaimVerdict::kNotClaimed;
  Claim worst;
};
std::vector<CertificateVerdict> ByStep(const std::vector<Claim>& claims);

}  // namespace assay::check
