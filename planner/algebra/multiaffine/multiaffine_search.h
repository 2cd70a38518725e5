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
#include "planner/algebra/multiaffine/wave_sum.h"

namespace assay::algebra {

// The rungs from monotone on, for multi-affine forms over boxes. It knows more of them than the
// ladder knows of any form: coordinates that monotonicity settles over the whole box are put into
// the form, and what is left is short; an angle in which the form is convex is at one of its ends,
// as a displacement is; a single angle has its extremum in closed form. Its memory is used again
// from one question to the next.
class MultiaffineSearch {
 public:
  explicit MultiaffineSearch(MultiaffineForm form);
  MultiaffineSearch(const MultiaffineSearch&) = delete;
  MultiaffineSearch& operator=(const MultiaffineSearch&) = delete;

  // Sets the box of the questions that follow, by VariableId. False where rounding errors cannot be
  // bounded over it: ends are infinite or far out.
  bool Enter(std::span<const Interval> box);

  // SUP of sign * form, sign being 1 or -1; `request.highest` is kMonotone at least. Puts the point
  // into `elsewhere`, which has a coordinate for every VariableId.
  Bound Maximize(int sign, const BoundRequest& request, std::vector<double> elsewhere);

 private:
  // A part of the box that may hold more than the best point.
  struct Part {
    double upper_bound = 0;
    std::int64_t age = 0;  // parts of the same bound: the oldest first
    double slack = 0;
    int sectors = 0;  // where those of the free variables begin in sectors_
    int waves = -1;   // in waves_, where only angles have freedom; -1: none
    int split = -1;   // the variable; -1: none is left that can be split
    bool has_only_ends = false;

    bool operator<(const Part& other) const {
      return upper_bound != other.upper_bound ? upper_bound < other.upper_bound : age > other.age;
    }
  };

  bool IsAngle(int variable) const { return variable < form_.angle_count; }

  // Of the whole box.
  void BoundErrors();
  void SettleWhole();
  void SettleBySlopesOfBox();
  void LowerAtCorner();
  void PutInSettled();
  void Climb(const StopRule& stop, Rung highest);
  double Search(const StopRule& stop);

  // Of the part that is looked at.
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
  void Lower(double upper_bound, Rung rung);
  bool IsHopeless() const { return upper_bound_ <= attained_; }

  // Of parts.
  void Keep();
  void ChooseSplit(Part& part) const;
  bool HasOnlyItsEnds(int variable) const;
  void Split(const Part& part);
  void Open(const Part& part, const Sector& half);
  int RoomForSectors();

  // Of the point.
  void PutAtLow();
  void PutAtMiddle();
  double Value();
  double Offer();

  const MultiaffineForm form_;
  MultiaffineDerivatives<NearestInterval> over_box_;
  MultiaffinePoint point_;
  MultiaffineAscent ascent_;
  NestedReduction reduction_;

  // The whole box, by variable.
  std::vector<Sector> box_;
  NearestInterval range_;
  std::vector<NearestInterval> slopes_;
  std::vector<double> slope_error_;
  double error_ = 0;
  double point_error_ = 0;
  double wave_reach_ = 0;  // the arguments of waves go no further

  // The question.
  int sign_ = 1;
  NestedForm reduced_;           // sign * form, with the coordinates put in that are settled
  std::vector<Sector> whole_;    // what monotonicity leaves of the box
  std::vector<int> free_;        // variables that have freedom there
  Rung rung_ = Rung::kMonotone;  // that gave the upper bound
  double attained_ = 0;
  std::vector<double> best_point_;
  std::int64_t evaluations_ = 0;
  std::int64_t splits_ = 0;

  // The part that is looked at.
  std::vector<Sector> part_;                  // by variable
  std::vector<int> live_;                     // variables that have freedom there
  int part_waves_ = -1;                       // in waves_
  std::vector<NearestInterval> part_slopes_;  // by variable
  std::vector<double> least_curvature_;       // by angle
  double upper_bound_ = 0;
  double slack_ = 0;  // lost at most where slopes were rounding alone

  std::vector<Part> parts_;  // a heap
  std::vector<Sector> sectors_;
  std::vector<int> unused_sectors_;
  std::int64_t age_ = 0;

  // What is left of the form where only angles have freedom, as waves; several parts share one.
  struct Waves {
    WaveSum sum;
    std::vector<int> angles;
    double error = 0;  // of the range, slopes and curvatures over any part
  };
  std::vector<Waves> waves_;
  int waves_count_ = 0;  // of this question
  WaveEvaluation wave_evaluation_;
  QuadraticBound quadratic_bound_;
  std::vector<NearestInterval> wave_box_;
  std::vector<double> widths_, middle_slopes_;
  std::vector<int> cosines_, live_places_;
  SymmetricMatrix curvature_;
  NestedForm angles_only_;
};

}  // namespace assay::algebra
