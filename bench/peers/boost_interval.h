#pragma once

#include <memory>
#include <span>

#include "planner/algebra/linear/constraint_set.h"

namespace assay::peers {

// Boost.Interval on an expression as it stands, operation by operation, with outward rounding:
// equal parts are evaluated once, numbers are converted beforehand. Of sums, products, powers,
// sines and cosines. Others may be evaluated along with it.
class BoostInterval {
 public:
  enum class Rounding {
    kByDefault,  // the library's policy: the processor's mode is set for every operation
    kSetOnce,    // for an evaluation as a whole, upward; lower ends are rounded as their opposites
  };
  BoostInterval(const algebra::Expression& e, std::span<const algebra::Expression> others,
                const algebra::ConstraintSet& box, Rounding rounding);
  ~BoostInterval();
  BoostInterval(BoostInterval&&) noexcept;

  Interval Range();

 private:
  class Evaluation;
  template <class Number, class Guard>
  class EvaluationIn;
  std::unique_ptr<Evaluation> evaluation_;
};

}  // namespace assay::peers
