#pragma once

#include <vector>

#include "planner/algebra/bounds/bound.h"
#include "planner/algebra/bounds/branch_and_bound.h"
#include "planner/algebra/multiaffine/multiaffine_question.h"
#include "planner/algebra/multiaffine/open_parts.h"
#include "planner/algebra/multiaffine/sector.h"
#include "planner/algebra/multiaffine/trigonometric_bounds.h"

namespace assay::algebra {

// The part of a box that a search is looking at. It bounds the question's reduced form over the
// part, by one method after the other.
class MultiaffinePart {
 public:
  explicit MultiaffinePart(MultiaffineQuestion& question);

  // Begins a question with the whole box. `sectors` are indexed by variable.
  void Begin(double upper_bound, std::vector<Sector> sectors);
  // Takes over the bound of a part that was suspended. Its sectors are set by the caller.
  void Continue(const OpenParts::Part& part);
  // Returns the part with the variable to split, without its sectors.
  OpenParts::Part Suspended() const;

  std::vector<Sector>& sectors() { return sectors_; }
  const std::vector<int>& live() const { return live_; }  // variables with a width in the part
  double upper_bound() const { return upper_bound_; }
  BoundingMethod method() const { return method_; }  // the method that gave the upper bound
  double slack() const { return slack_; }
  bool IsHopeless() const { return upper_bound_ <= question_.attained; }

  void EnterSector(int variable);
  void PutAtLow();
  // Sets variables to the end at which the form is largest if it does not fall on the way there.
  void Settle();
  // Bounds the part. Call Settle first.
  void Examine();

 private:
  void EvaluateNested();
  void EvaluatePolynomial();
  double SlopeError(int variable) const;
  bool SettleBySlope(int variable);
  bool TurnToPolynomial();
  void LowerAtPoint();
  void LowerByOneAngle();
  void LowerByCentre();
  void LowerByCurvature();
  void LowerByConcavity();
  double TangentBound();
  void Lower(double upper_bound, BoundingMethod method);
  bool HasOnlyItsEnds(int variable) const;
  void PutAtMiddle();

  MultiaffineQuestion& question_;
  std::vector<Sector> sectors_;
  std::vector<int> live_;
  std::vector<numeric::NearestInterval> slopes_;  // indexed by variable
  std::vector<double> least_curvature_;           // indexed by angle
  double upper_bound_ = 0;
  BoundingMethod method_ = BoundingMethod::kMonotone;
  // An upper bound of the loss by variables that were settled although their slopes were within the
  // rounding error of 0.
  double slack_ = 0;

  TrigonometricBounds polynomials_;  // the form, for parts in which only angles are free
  int number_ = -1;                  // of this part's polynomial; -1: none yet
  std::vector<double> middle_slopes_;
  NestedForm angles_only_;
};

}  // namespace assay::algebra
