#include "planner/geometry/zonotopes/zonotope.h"

#include "planner/base/check.h"

namespace assay::geometry {

Zonotope Zonotope::Box(const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  ASSAY_CHECK(low.size() == high.size() && (low.array() <= high.array()).all());
  Zonotope box{(low + high) / 2,
               Eigen::MatrixXd::Zero(low.size(), (low.array() < high.array()).count())};
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < low.size(); ++i) {
    if (low[i] < high[i]) box.generators(i, column++) = (high[i] - low[i]) / 2;
  }
  return box;
}

double Zonotope::Support(const Eigen::VectorXd& a) const {
  return a.dot(center) + (generators.transpose() * a).lpNorm<1>();
}

Eigen::VectorXd Zonotope::Farthest(const Eigen::VectorXd& a) const {
  const Eigen::VectorXd rises = generators.transpose() * a;
  return center + generators * rises.cwiseSign();
}

}  // namespace assay::geometry
