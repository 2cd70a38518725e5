#pragma once

#include <span>
#include <vector>

#include "planner/algebra/multiaffine/multiaffine_point.h"
#include "planner/numeric/positive_definite.h"

namespace assay::algebra {

// Searches for a point at which a multi-affine form is large. As in ascent.h, the search uses
// doubles and guarantees nothing. Displacements move to the ends that their slopes point to. Angles
// move by Newton's method, damped where the form is not concave.
class MultiaffineAscent {
 public:
  explicit MultiaffineAscent(MultiaffinePoint& point) : point_(point) {}

  // Moves the point's given variables within their sectors (indexed by variable), starting from
  // their present values. Returns the number of evaluations.
  int Climb(const NestedForm& form, std::span<const int> variables,
            std::span<const Sector> sectors);

 private:
  // The functions below are the parts of one climb.
  bool Improve();
  bool ImproveByEnds();
  bool ImproveByNewton();
  void FindMovableAngles();
  void FindCurvature();
  bool IsLast() const;
  void MoveBy(std::span<const double> step);
  double Value();
  bool KeepIfBetter();

  MultiaffinePoint& point_;
  const NestedForm* form_ = nullptr;
  std::span<const int> variables_;
  std::span<const Sector> sectors_;
  double value_ = 0;
  int evaluations_ = 0;
  std::vector<double> start_;  // the coordinates before a step
  std::vector<int> movable_;   // angles whose slopes do not hold them at an end
  std::vector<double> slope_;  // the slopes of the movable angles
  std::vector<double> step_;
  numeric::SymmetricMatrix curvature_;  // the negated second derivatives
  numeric::SymmetricMatrix damped_;
};

}  // namespace assay::algebra
