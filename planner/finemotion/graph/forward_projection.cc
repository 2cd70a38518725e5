#include "planner/finemotion/graph/forward_projection.h"

#include <algorithm>

#include "planner/base/check.h"

namespace assay::finemotion {

namespace {

// A direction counts as mapped to 0 if less than this fraction of its length remains, which is
// rounding.
constexpr double kMappedToNothing = 1e-14;

// The oblique projection onto the contact's C-surface along a velocity: it maps z to `linear` z +
// `offset`.
struct AlongVelocity {
  Eigen::MatrixXd linear;
  Eigen::VectorXd offset;
};

AlongVelocity OntoSurface(const PrimitiveContact& contact, const Eigen::VectorXd& velocity) {
  // The step along the velocity that changes the gap by 1.
  const Eigen::VectorXd step = velocity / contact.row.dot(velocity);
  const Eigen::Index n = velocity.size();
  return {Eigen::MatrixXd::Identity(n, n) - step * contact.row.transpose(), -contact.offset * step};
}

// Returns the generators' images, without those that are mapped to 0.
Eigen::MatrixXd Images(const Eigen::MatrixXd& linear, const Eigen::MatrixXd& generators) {
  const Eigen::MatrixXd images = linear * generators;
  Eigen::MatrixXd kept(images.rows(), images.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < images.cols(); ++i) {
    const double nothing = kMappedToNothing * linear.norm() * generators.col(i).norm();
    if (images.col(i).norm() > nothing) kept.col(count++) = images.col(i);
  }
  return kept.leftCols(count);
}

}  // namespace

double ForwardProjection::Support(const Eigen::VectorXd& a) const {
  return start.Support(a) + time * std::max(0.0, velocity.Support(a));
}

GeneralizedPoint ForwardProjection::Farthest(const Eigen::VectorXd& a) const {
  const GeneralizedPoint begin = start.Farthest(a);
  const Eigen::VectorXd v = velocity.Farthest(a);
  return a.dot(v) > 0 ? begin + time * v : begin;
}

// A motion from z at velocity v0 + e is on the surface after some time s. The projection P along v0
// leaves that point where it is and removes s v0. So the point is P z + s (linear part of P) e. The
// time s is at most that of the farthest start at the slowest approach.
geometry::Zonotope RegionAtContact(const ForwardProjection& projection,
                                   const PrimitiveContact& contact) {
  const geometry::Zonotope& start = projection.start;
  const geometry::Zonotope& velocity = projection.velocity;
  const double slowest = -velocity.Support(contact.row);
  ASSAY_CHECK(slowest > 0, "a motion does not approach the surface");
  const double farthest = contact.offset + start.Support(contact.row);
  const double longest = std::clamp(farthest / slowest, 0.0, projection.time);

  const AlongVelocity onto = OntoSurface(contact, velocity.center);
  const geometry::Zonotope hits{onto.linear * start.center + onto.offset,
                                Images(onto.linear, start.generators)};
  const geometry::Zonotope spread{Eigen::VectorXd::Zero(start.center.size()),
                                  Images(longest * onto.linear, velocity.generators)};
  return Sum(hits, spread);
}

}  // namespace assay::finemotion
