#pragma once

#include <span>
#include <vector>

#include "planner/algebra/multiaffine/multiaffine_point.h"
#include "planner/algebra/numeric/positive_definite.h"

namespace assay::algebra {

// As ascent.h, for multi-affine forms: searches for a point where the form is large, in doubles and
// without any promise. Displacements go to the ends that their slopes point to, angles by Newton's
// method, damped where the form is not concave.
class MultiaffineAscent {
 public:
  explicit MultiaffineAscent(MultiaffinePoint& point) : point_(point) {}

  // Moves the point's given variables within their sectors (by variable), from where they are.
  // Returns the number of evaluations.
  int Climb(const NestedForm& form, std::span<const int> variables,
            std::span<const Sector> sectors);

 private:
  // Of one climb.
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
  std::vector<double> start_;  // coordinates before a step
  std::vector<int> movable_;   // angles that their slopes do not hold at an end
  std::vector<double> slope_;  // of those
  std::vector<double> step_;
  SymmetricMatrix curvature_;  // minus the second derivatives
  SymmetricMatrix damped_;
};

}  // namespace assay::algebra
