#include "planner/finemotion/contact_graph/cone_form.h"

#include <algorithm>

#include "planner/base/check.h"
#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

namespace {

// A unit normal depends on earlier normals if its component across their span is shorter than this.
constexpr double kDependentNormal = 1e-9;
constexpr double kAgree = 1e-9;  // greatest relative difference of values of rows that agree

// Collects normals that are independent of those before them, with an orthonormal basis of their
// span. Gram and Schmidt's method runs twice for each normal to remove rounding errors.
class IndependentRows {
 public:
  explicit IndependentRows(Eigen::Index dimensions) : basis_(dimensions, 0), rows_(0, dimensions) {}

  bool Take(const Eigen::VectorXd& normal, double value) {
    const double size = normal.norm();
    Eigen::VectorXd rest = normal - basis_ * (basis_.transpose() * normal);
    rest -= basis_ * (basis_.transpose() * rest);
    if (rest.norm() <= kDependentNormal * size) return false;
    basis_.conservativeResize(Eigen::NoChange, basis_.cols() + 1);
    basis_.rightCols<1>() = rest.normalized();
    rows_.conservativeResize(rows_.rows() + 1, Eigen::NoChange);
    rows_.bottomRows<1>() = normal.transpose();
    values_.conservativeResize(rows_.rows());
    values_[rows_.rows() - 1] = value;
    return true;
  }

  // Returns the dual basis: column i is in the span of all rows, orthogonal to every row but the
  // i-th, and 1 along the i-th.
  Eigen::MatrixXd Dual() const {
    const Eigen::MatrixXd triangular = rows_ * basis_;
    return basis_ * numeric::InverseOfLowerTriangular(triangular);
  }

  const Eigen::MatrixXd& basis() const { return basis_; }
  const Eigen::VectorXd& values() const { return values_; }

 private:
  Eigen::MatrixXd basis_;  // orthonormal basis vectors, one column each
  Eigen::MatrixXd rows_;   // coefficients of the rows in the basis, lower triangular
  Eigen::VectorXd values_;
};

void CheckRowsAgree(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values,
                    const GeneralizedPoint& z) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double size = std::max(std::abs(values[i]), rows.row(i).norm() * z.norm());
    ASSAY_CHECK(std::abs(rows.row(i).dot(z) - values[i]) <= kAgree * std::max(1.0, size),
                "row {} of {} contradicts those it depends on", i, rows.rows());
  }
}

}  // namespace

ConeForm ConeFormOf(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values,
                    const std::vector<HalfSpace>& limits) {
  IndependentRows independent(rows.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) independent.Take(rows.row(i), values[i]);
  const Eigen::Index equations = independent.values().size();
  ConeForm form;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    if (independent.Take(limits[i].a, limits[i].b)) form.limits.push_back(static_cast<int>(i));
  }
  const Eigen::MatrixXd dual = independent.Dual();
  form.characteristic_point = dual * independent.values();
  form.rays = -dual.rightCols(dual.cols() - equations).colwise().normalized();
  form.tangents = numeric::OrthogonalComplement(independent.basis());
  CheckRowsAgree(rows, values, form.characteristic_point);
  return form;
}

}  // namespace assay::finemotion
