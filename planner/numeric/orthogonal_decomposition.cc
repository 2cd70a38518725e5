#include "planner/numeric/orthogonal_decomposition.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace assay::numeric {

Eigen::MatrixXd ShortestLeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                     std::optional<double> threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  if (threshold) decomposition.setThreshold(*threshold);
  decomposition.compute(a);
  return decomposition.solve(b);
}

Eigen::VectorXd LeastSquaresOfFewest(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::MatrixXd OrthogonalComplement(const Eigen::MatrixXd& basis) {
  const Eigen::Index dimensions = basis.rows();
  if (basis.cols() == 0) return Eigen::MatrixXd::Identity(dimensions, dimensions);
  const Eigen::MatrixXd q = basis.householderQr().householderQ();
  return q.rightCols(dimensions - basis.cols());
}

IndependentColumns IndependentColumnsOf(const Eigen::MatrixXd& a, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a.rows(), a.cols());
  qr.setThreshold(threshold);
  qr.compute(a);
  const Eigen::Index rank = qr.rank();
  const Eigen::MatrixXd q = qr.householderQ();
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(rank, rank);  // the transpose of R
  IndependentColumns independent;
  for (Eigen::Index i = 0; i < rank; ++i) {
    independent.columns.push_back(qr.colsPermutation().indices()[i]);
    for (Eigen::Index j = 0; j <= i; ++j) lower(i, j) = qr.matrixR()(j, i);
  }
  independent.dual = q.leftCols(rank) * InverseOfLowerTriangular(lower);
  independent.complement = q.rightCols(a.rows() - rank);
  return independent;
}

Eigen::MatrixXd InverseOfLowerTriangular(const Eigen::MatrixXd& a) {
  return a.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(a.rows(), a.rows()));
}

Eigen::Matrix<double, 6, 1> EigenvaluesOfSymmetric(const Eigen::Matrix<double, 6, 6>& a) {
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>;
  return Solver(a, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace assay::numeric
