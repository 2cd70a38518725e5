#pragma once

#include <string>
#include <vector>

#include "planner/plan/certificates/condition.h"
#include "sim/check/measurements/measured_step.h"

namespace assay::check {

// The margin by which preconditions about one subject hold, the worst of them, measured where parts
// and hand truly were.
struct MeasuredMargin {
  std::string subject;  // plan::CertifiedPrecondition::meaning; empty: all of that condition
  // In SI units of the condition's dimension; negative if one of them does not hold.
  double observed = 0;
  // True if the observed value must be at least the certificate's margin. It is false for
  // clearances between bodies: their margin is certified for some corners only. The certificate
  // leaves out corners if a bound shows that no error closes their gap. This gap may be smaller
  // than the margin.
  bool is_at_least_the_margin = true;
  // True if the certificate counts on a wrist that yields. Simulated arms have none. If a shaft
  // would need one, the trial proves nothing about the plan.
  bool counts_on_yielding = false;
};

// The way in which one kind of precondition is measured in a trace.
struct Measurement {
  plan::Condition condition;
  // Returns the margins of all preconditions of the kind in the step's certificate. The list is
  // empty if the execution did not come to the point at which the kind can be measured. The
  // geometry is computed from the parts' boxes and features alone, not from the planner's
  // expressions. The function is null if nothing measures the kind.
  std::vector<MeasuredMargin> (*measure)(const MeasuredStep& step) = nullptr;

  bool is_measured() const { return measure != nullptr; }
};

// Each of these functions returns the measurements of one group of kinds of preconditions. Each
// file *_measurements.cc defines one of these functions.
std::vector<Measurement> GraspMeasurements();
std::vector<Measurement> LandingMeasurements();
std::vector<Measurement> MatingMeasurements();
std::vector<Measurement> HandMeasurements();

// Returns the measurements of all kinds that the planner knows, one for each kind.
const std::vector<Measurement>& KnownMeasurements();

// Returns the measurement of a kind, which must be in the list (checked).
const Measurement& MeasurementOf(plan::Condition condition,
                                 const std::vector<Measurement>& measurements);

// Adds a margin unless the observed value is infinite. An infinite distance means that there is
// nothing to which a distance could be measured.
void AddFinite(std::string subject, double observed, std::vector<MeasuredMargin>& measured);
// Adds a clearance between two bodies. If the shapes overlap, their distance is 0 and the depth of
// the overlap is unknown. They then get a fixed negative value.
void AddClearance(std::string subject, double distance, std::vector<MeasuredMargin>& measured);
// Returns the margin of all preconditions of a kind; empty if the observed value is infinite.
std::vector<MeasuredMargin> OfAll(double observed);

}  // namespace assay::check
