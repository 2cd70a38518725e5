#pragma once

#include <memory>
#include <span>

#include "planner/algebra/sup_inf/constraint_set.h"

namespace assay::peers {

// Evaluates an expression with Boost.Interval as it stands, operation by operation, with outward
// rounding. Equal subexpressions are evaluated once, and numbers are converted beforehand. It
// supports sums, products, powers, sines and cosines. Other expressions may be evaluated along with
// it.
class BoostInterval {
 public:
  enum class Rounding {
    kByDefault,  // the library's policy: the processor's mode is set for each operation
    kSetOnce,    // the mode is set once, upward; lower ends are rounded as their negatives
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
