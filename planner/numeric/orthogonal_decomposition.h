#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace assay::numeric {

// Eigen's matrix decompositions behind plain functions. Each type of matrix costs the compiler
// seconds, so most functions use the same type, and this type is compiled in one file alone. Exact
// replays solve many small problems; they have a decomposition of their own that allocates nothing.

// Returns, for each column of b, the shortest x for which |a x - b| is least. Pivots of at most
// `threshold` times the greatest one count as 0. Without a threshold, rounding decides which pivots
// are 0.
Eigen::MatrixXd ShortestLeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                     std::optional<double> threshold = {});

// Returns an x for which |a x - b| is least. It is 0 for those columns of a that depend on others.
Eigen::VectorXd LeastSquaresOfFewest(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// Returns an orthonormal basis, as columns, of the space that is orthogonal to the columns of
// `basis`.
Eigen::MatrixXd OrthogonalComplement(const Eigen::MatrixXd& basis);

// Columns of a matrix that are independent, as many as its rank. Pivots of at most `threshold`
// times the greatest one count as 0.
struct IndependentColumns {
  std::vector<int> columns;  // indices into the matrix, the greatest pivot first
  // Column i is in the span of the independent columns. Its product with the i-th of these columns
  // is 1, and its products with all others are 0.
  Eigen::MatrixXd dual;
  Eigen::MatrixXd complement;  // orthonormal columns, orthogonal to all of them
};
IndependentColumns IndependentColumnsOf(const Eigen::MatrixXd& a, double threshold);

Eigen::MatrixXd InverseOfLowerTriangular(const Eigen::MatrixXd& a);

// Returns the eigenvalues in ascending order.
Eigen::Matrix<double, 6, 1> EigenvaluesOfSymmetric(const Eigen::Matrix<double, 6, 6>& a);

}  // namespace assay::numeric
