#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/algebra/bounds/bound.h"
#include "planner/algebra/bounds/branch_and_bound.h"
#include "planner/algebra/multiaffine/multiaffine_form.h"
#include "planner/algebra/multiaffine/multiaffine_part.h"
#include "planner/algebra/multiaffine/multiaffine_question.h"
#include "planner/algebra/multiaffine/open_parts.h"
#include "planner/algebra/multiaffine/sector.h"

namespace assay::algebra {

// Applies the bounding methods from kMonotone on to a multi-affine form over a box. It uses special
// properties of these forms. Coordinates that monotonicity settles over the whole box are
// substituted, so that the remaining form is short. At the maximum, every displacement and every
// angle in which the form is convex is at one of its ends. A single remaining angle has its
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
  struct UpperBound {
    double value = 0;
    BoundingMethod method = BoundingMethod::kMonotone;
  };

  void SettleWhole();
  void SettleBySlopesOfBox();
  UpperBound BoundAtCorner();
  UpperBound Climb(const StopRule& stop, BoundingMethod highest);
  double Search(const StopRule& stop);
  void Split(const OpenParts::Part& part);
  void Open(const OpenParts::Part& part, const Sector& half);
  void Keep();

  MultiaffineQuestion question_;
  MultiaffinePart part_;
  OpenParts parts_;
  std::int64_t splits_ = 0;

  // The whole box, and the form's range and slopes over this box. Box and slopes are indexed by
  // variable.
  std::vector<Sector> box_;
  numeric::NearestInterval range_;
  std::vector<numeric::NearestInterval> slopes_;
};

}  // namespace assay::algebra
