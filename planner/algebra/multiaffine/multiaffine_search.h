#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/algebra/bounds/bound.h"
#include "planner/algebra/bounds/branch_and_bound.h"
#include "planner/algebra/methods/quadratic_bound.h"
#include "planner/algebra/multiaffine/multiaffine_ascent.h"
#include "planner/algebra/multiaffine/multiaffine_derivatives.h"
#include "planner/algebra/multiaffine/multiaffine_form.h"
#include "planner/algebra/multiaffine/multiaffine_point.h"
#include "planner/algebra/multiaffine/sector.h"
#include "planner/algebra/multiaffine/trigonometric_polynomial.h"

namespace assay::algebra {

// Applies the bounding methods from kMonotone on to a multi-affine form over a box. It uses special
// properties of these forms. Coordinates that monotonicity settles over the whole box are
// substituted, so that the remaining form is short. At the maximum, every displacement is at one of
// its ends, and so is every angle in which the form is convex. A single remaining angle has its
// extremum in closed form. The memory is reused from one question to the next.
class MultiaffineSearch {
 public:
  explicit MultiaffineSearch(MultiaffineForm form);
  MultiaffineSearch(const MultiaffineSearch&) = delete;
  MultiaffineSearch& operator=(const MultiaffineSearch&) = delete;

  // Sets the box of the following questions, indexed by VariableId. Returns false if rounding
  // errors cannot be bounded over it, because ends are infinite or far out.
  bool Enter(std::span<const Interval> box);

  // Returns SUP of sign * form, where sign is 1 or -1. `request.highest` must be at least
  // kMonotone. `elsewhere` has a coordinate for every VariableId; the returned point is `elsewhere`
  // with the form's variables replaced.
  Bound Maximize(int sign, const BoundRequest& request, std::vector<double> elsewhere);

 private:
  // A part of the box in which the form may exceed the best point.
  struct Part {
    double upper_bound = 0;
    std::int64_t age = 0;  // breaks ties: of parts with the same bound the oldest comes first
    double slack = 0;
    int sectors = 0;  // where the sectors of the free variables begin in sectors_
    int waves = -1;   // index in waves_ if only angles are free; -1: none
    int split = -1;   // the variable; -1: none can be split further
    bool has_only_ends = false;

    bool operator<(const Part& other) const {
      return upper_bound != other.upper_bound ? upper_bound < other.upper_bound : age > other.age;
    }
  };

  bool IsAngle(int variable) const { return variable < form_.angle_count; }

  // These functions work on the whole box.
  void BoundErrors();
  void SettleWhole();
  void SettleBySlopesOfBox();
  void LowerAtCorner();
  void PutInSettled();
  void Climb(const StopRule& stop, BoundingMethod highest);
  double Search(const StopRule& stop);

  // These functions work on the current part.
  void EnterSector(int variable);
  void Settle();
  void EvaluateNested();
  void EvaluateWaves();
  double SlopeError(int variable) const;
  bool SettleBySlope(int variable);
  void Examine();
  void LowerAtPoint();
  void LowerByOneAngle();
  bool TurnToWaves();
  NestedForm::AtomSet AtomsOf(const std::vector<int>& variables) const;
  void LowerByCentre();
  void LowerByCurvature();
  void LowerByConcavity();
  double TangentBound();
  void Lower(double upper_bound, BoundingMethod method);
  bool IsHopeless() const { return upper_bound_ <= attained_; }

  // These functions manage parts.
  void Keep();
  void ChooseSplit(Part& part) const;
  bool HasOnlyItsEnds(int variable) const;
  void Split(const Part& part);
  void Open(const Part& part, const Sector& half);
  int RoomForSectors();

  // These functions move or evaluate the point.
  void PutAtLow();
  void PutAtMiddle();
  double Value();
  double Offer();

  const MultiaffineForm form_;
  MultiaffineDerivatives<NearestInterval> over_box_;
  MultiaffinePoint point_;
  MultiaffineAscent ascent_;
  NestedReduction reduction_;

  // The members below describe the whole box and are indexed by variable.
  std::vector<Sector> box_;
  NearestInterval range_;
  std::vector<NearestInterval> slopes_;
  std::vector<double> slope_error_;
  double error_ = 0;
  double point_error_ = 0;
  double wave_reach_ = 0;  // a bound of the arguments of the trigonometric polynomials

  // The members below describe the current question.
  int sign_ = 1;
  NestedForm reduced_;         // sign * form with the settled coordinates substituted
  std::vector<Sector> whole_;  // the part of the box that monotonicity leaves
  std::vector<int> free_;      // variables with a width in whole_
  BoundingMethod method_ = BoundingMethod::kMonotone;  // the method that gave the upper bound
  double attained_ = 0;
  std::vector<double> best_point_;
  std::int64_t evaluations_ = 0;
  std::int64_t splits_ = 0;

  // The members below describe the current part.
  std::vector<Sector> part_;                  // indexed by variable
  std::vector<int> live_;                     // variables with a width in the part
  int part_waves_ = -1;                       // index in waves_
  std::vector<NearestInterval> part_slopes_;  // indexed by variable
  std::vector<double> least_curvature_;       // indexed by angle
  double upper_bound_ = 0;
  // An upper bound of the loss by variables that were settled although their slopes were within the
  // rounding error of 0.
  double slack_ = 0;

  std::vector<Part> parts_;  // a heap
  std::vector<Sector> sectors_;
  std::vector<int> unused_sectors_;
  std::int64_t age_ = 0;

  // The remaining form as a trigonometric polynomial, for parts in which only angles are free.
  // Several parts may share one polynomial.
  struct Waves {
    TrigonometricPolynomial sum;
    std::vector<int> angles;
    double error = 0;  // rounding error of range, slopes and curvatures over any part
  };
  std::vector<Waves> waves_;
  int waves_count_ = 0;  // number of elements that this question uses
  WaveEvaluation wave_evaluation_;
  QuadraticBound quadratic_bound_;
  std::vector<NearestInterval> wave_box_;
  std::vector<double> widths_, middle_slopes_;
  std::vector<int> cosines_, live_places_;
  SymmetricMatrix curvature_;
  NestedForm angles_only_;
};

}  // namespace assay::algebra
