#pragma once

#include <Eigen/Core>

namespace assay::numeric {

// Returns an x >= 0 for which |a x - b| is least (Lawson and Hanson 1974, chapter 23). If there are
// several, it returns one of them.
Eigen::VectorXd NonnegativeLeastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace assay::numeric
