#include "planner/numeric/nonnegative_least_squares.h"

#include <algorithm>
#include <vector>

#include "planner/base/check.h"
#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::numeric {
namespace {

constexpr double kTolerance = 1e-12;

class Solver {
 public:
  Solver(const Eigen::MatrixXd& a, const Eigen::VectorXd& b)
      : a_(a),
        b_(b),
        tolerance_(kTolerance * std::max(1.0, a.cwiseAbs().maxCoeff()) *
                   std::max(1.0, b.cwiseAbs().maxCoeff())),
        x_(Eigen::VectorXd::Zero(a.cols())),
        is_free_(static_cast<std::size_t>(a.cols()), false) {}

  Eigen::VectorXd Solve() {
    for (Eigen::Index round = 0; round < 10 * a_.cols() + 10; ++round) {
      const Eigen::Index entering = SteepestHeld();
      if (entering < 0) return x_;
      is_free_[static_cast<std::size_t>(entering)] = true;
      StepUntilFeasible();
      // Rounding can let a column enter and leave at once, which would repeat for ever without any
      // gain.
      if (!is_free_[static_cast<std::size_t>(entering)]) return x_;
    }
    return x_;
  }

 private:
  Eigen::Index SteepestHeld() const {
    const Eigen::VectorXd gradient = a_.transpose() * (b_ - a_ * x_);
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      if (is_free_[static_cast<std::size_t>(i)] || gradient[i] <= tolerance_) continue;
      if (best < 0 || gradient[i] > gradient[best]) best = i;
    }
    return best;
  }

  void StepUntilFeasible() {
    for (;;) {
      const Eigen::VectorXd wanted = LeastSquaresOfFree();
      double step = 1;
      for (Eigen::Index i = 0; i < x_.size(); ++i) {
        if (is_free_[static_cast<std::size_t>(i)] && wanted[i] <= 0) {
          step = std::min(step, x_[i] / (x_[i] - wanted[i]));
        }
      }
      x_ += step * (wanted - x_);
      if (step == 1) return;
      for (Eigen::Index i = 0; i < x_.size(); ++i) {
        if (!is_free_[static_cast<std::size_t>(i)] || x_[i] > kTolerance) continue;
        x_[i] = 0;
        is_free_[static_cast<std::size_t>(i)] = false;
      }
    }
  }

  Eigen::VectorXd LeastSquaresOfFree() const {
    Eigen::MatrixXd free(a_.rows(), x_.size());
    std::vector<Eigen::Index> columns;
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      if (!is_free_[static_cast<std::size_t>(i)]) continue;
      free.col(static_cast<Eigen::Index>(columns.size())) = a_.col(i);
      columns.push_back(i);
    }
    free.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(columns.size()));
    const Eigen::VectorXd of_free = LeastSquaresOfFewest(free, b_);
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(x_.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
      wanted[columns[i]] = of_free[static_cast<Eigen::Index>(i)];
    }
    return wanted;
  }

  const Eigen::MatrixXd& a_;
  const Eigen::VectorXd& b_;
  const double tolerance_;
  Eigen::VectorXd x_;
  std::vector<bool> is_free_;
};

}  // namespace

Eigen::VectorXd NonnegativeLeastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  ASSAY_CHECK(a.rows() == b.size());
  if (a.cols() == 0) return {};
  return Solver(a, b).Solve();
}

}  // namespace assay::numeric
