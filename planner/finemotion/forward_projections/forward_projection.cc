#include "planner/finemotion/forward_projections/forward_projection.h"

#include <algorithm>

namespace assay::finemotion {

double ForwardProjection::Support(const Eigen::VectorXd& a) const {
  return start.Support(a) + time * std::max(0.0, velocity.Support(a));
}

GeneralizedPoint ForwardProjection::Farthest(const Eigen::VectorXd& a) const {
  const GeneralizedPoint begin = start.Farthest(a);
  const Eigen::VectorXd v = velocity.Farthest(a);
  return a.dot(v) > 0 ? begin + time * v : begin;
}

}  // namespace assay::finemotion
