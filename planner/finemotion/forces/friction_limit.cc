#include "planner/finemotion/forces/friction_limit.h"

#include "planner/finemotion/forces/force_signature.h"
#include "planner/numeric/nonnegative_least_squares.h"
#include "planner/numeric/orthogonal_decomposition.h"
#include "planner/plan/data/strategy.h"

namespace assay::finemotion {

namespace {

constexpr double kHeld = 1e-9;
constexpr double kPrecision = 1.01;

}  // namespace

bool CanHold(const std::vector<PrimitiveContact>& kept,
             const Eigen::Matrix<double, kPoseDimensions, 1>& displacement, double friction) {
  if (kept.empty()) return false;
  const Eigen::Index n = std::ssize(kept);
  Eigen::MatrixXd normals(kPoseDimensions, n);
  for (Eigen::Index i = 0; i < n; ++i)
    normals.col(i) = kept[static_cast<std::size_t>(i)].row.head<kPoseDimensions>();
  ForceSignature signature = SignatureOf(kept, friction);
  const double speed =
      displacement.head<3>().norm() + plan::kTurnLever * displacement.tail<3>().norm();
  const Eigen::RowVectorXd power = displacement.transpose() / speed * signature.rays;
  signature.rays.bottomRows<3>() /= plan::kTurnLever;
  normals.bottomRows<3>() /= plan::kTurnLever;
  Eigen::MatrixXd columns(n + 1, signature.rays.cols());
  columns << numeric::ShortestLeastSquares(normals, signature.rays), power;
  const Eigen::VectorXd against = -Eigen::VectorXd::Unit(n + 1, n);
  return (columns * numeric::NonnegativeLeastSquares(columns, against) - against).norm() < kHeld;
}

double FrictionLimit(const std::vector<PrimitiveContact>& kept,
                     const Eigen::Matrix<double, kPoseDimensions, 1>& displacement) {
  double high = kGreatestFriction;
  if (!CanHold(kept, displacement, high)) return high;
  double low = 0;
  while (high > kPrecision * low) {
    const double middle = low > 0 ? std::sqrt(low * high) : high / 2;
    if (high < kHeld) return 0;
    (CanHold(kept, displacement, middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace assay::finemotion
