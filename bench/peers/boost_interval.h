#pragma once

#include <memory>

#include "planner/algebra/constraint_set.h"

namespace assay::peers {

// Boost.Interval on an expression as it stands, operation by operation, with outward rounding:
// equal parts are evaluated once, numbers are converted beforehand. Of sums, products, powers,
// sines and cosines.
class BoostInterval {
 public:
  BoostInterval(const algebra::Expression& e, const algebra::ConstraintSet& box);
  ~BoostInterval();
  BoostInterval(BoostInterval&&) noexcept;

  Interval Range();

 private:
  class Evaluation;
  std::unique_ptr<Evaluation> evaluation_;
};

}  // namespace assay::peers
