#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/finemotion/numeric/generalized_point.h"

namespace assay::finemotion {

// What Eigen decomposes matrices for. It takes the compiler seconds for each type of matrix, so
// that there is mostly one, and it is compiled here alone. (Exact replays solve small problems all
// the time: they have one of their own, which allocates nothing.)

// The shortest of all x for which |a x - b| is least, for each column of b. Pivots that are not
// above `threshold` times the greatest are taken for 0; none: by rounding.
Eigen::MatrixXd ShortestLeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                     std::optional<double> threshold = {});

// An x for which |a x - b| is least: the one that is 0 where a's columns depend on others.
Eigen::VectorXd LeastSquaresOfFewest(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// Orthonormal columns, orthogonal to the independent ones of `basis`, as many as there can be.
Eigen::MatrixXd OrthogonalComplement(const Eigen::MatrixXd& basis);

// Columns that are independent, as many as the rank: pivots that are not above `threshold` times
// the greatest are taken for 0.
struct IndependentColumns {
  std::vector<int> columns;    // the greatest pivot's first
  Eigen::MatrixXd dual;        // in their span: 1 along the one, 0 along the others, for each
  Eigen::MatrixXd complement;  // orthonormal, orthogonal to all
};
IndependentColumns IndependentColumnsOf(const Eigen::MatrixXd& a, double threshold);

Eigen::MatrixXd InverseOfLowerTriangular(const Eigen::MatrixXd& a);

// Ascending.
Eigen::Matrix<double, kPoseDimensions, 1> EigenvaluesOfSymmetric(
    const Eigen::Matrix<double, kPoseDimensions, kPoseDimensions>& a);

}  // namespace assay::finemotion
