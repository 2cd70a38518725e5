#pragma once

#include <fmt/format.h>

#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/base/random.h"

namespace assay::algebra {

// A pool with variables x0, x1, ... in [-2, 2], and random expressions over them with every
// operator. Some numbers have few digits and some have many, so that some sums are exact and some
// are not.
class RandomExpressions {
 public:
  RandomExpressions(RandomStream& random, int variables) : random_(random) {
    for (int i = 0; i < variables; ++i) {
      variables_.push_back(pool_.Declare(fmt::format("x{}", i), {-2, 2}));
    }
  }

  ExpressionPool& pool() { return pool_; }
  const std::vector<Expression>& variables() const { return variables_; }

  Expression Draw(int depth) {
    if (depth == 0 || random_.Index(6) == 0) return DrawLeaf();
    const Expression a = Draw(depth - 1);
    switch (random_.Index(12)) {
      case 0:
        return a + Draw(depth - 1);
      case 1:
        return a - Draw(depth - 1);
      case 2:
        return a * Draw(depth - 1);
      case 3:
        return -a;
      case 4:
        return a / Draw(depth - 1);
      case 5:
        return Power(a, random_.Index(7) - 3);
      case 6:
        return Sin(a);
      case 7:
        return Cos(a);
      case 8:
        return Sqrt(a);
      case 9:
        return Abs(a);
      case 10:
        return Min(a, Draw(depth - 1));
      default:
        return Max(a, Draw(depth - 1));
    }
  }

  std::vector<double> DrawPoint() {
    std::vector<double> point;
    for (std::size_t i = 0; i < variables_.size(); ++i) point.push_back(random_.Uniform(-2, 2));
    return point;
  }

 private:
  Expression DrawLeaf() {
    switch (random_.Index(4)) {
      case 0:
        return pool_.Constant(random_.Index(9) - 4);
      case 1:
        return pool_.Constant(random_.Uniform(-3, 3));
      default:
        return variables_[random_.Index(static_cast<int>(variables_.size()))];
    }
  }

  RandomStream& random_;
  ExpressionPool pool_;
  std::vector<Expression> variables_;
};

}  // namespace assay::algebra
