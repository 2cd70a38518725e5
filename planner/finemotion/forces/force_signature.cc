#include "planner/finemotion/forces/force_signature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/base/check.h"
#include "planner/numeric/nonnegative_least_squares.h"

namespace assay::finemotion {
namespace {

constexpr double kSameWrench = 1e-7;  // sine of the angle below which two wrenches are equal

using Rays = Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>;

// `Contact` has a normal and the place `at` where it is.
template <class Contact>
Wrench OfForce(const Contact& contact, const Vector3& force) {
  Wrench wrench;
  wrench << force, contact.at.cross(force);
  return wrench;
}

Rays Compared(Rays rays, double length) {
  rays.bottomRows<3>() /= length;
  return rays.colwise().normalized();
}

// Returns the distance of a mean of the unit columns of `a` from the nonnegative combinations of
// the columns of `b`. If means are scaled by t, the least of |a x - b y|^2 + (sum x - 1)^2 is the
// least of t^2 d^2 + (t - 1)^2, which is d^2 / (1 + d^2). It grows with the distance d, so both are
// least for the same means.
double DistanceOfMeans(const Rays& a, const Rays& b) {
  Eigen::MatrixXd columns(kPoseDimensions + 1, a.cols() + b.cols());
  columns << a, -b, Eigen::RowVectorXd::Ones(a.cols()), Eigen::RowVectorXd::Zero(b.cols());
  const Eigen::VectorXd one = Eigen::VectorXd::Unit(kPoseDimensions + 1, kPoseDimensions);
  const Eigen::VectorXd x = numeric::NonnegativeLeastSquares(columns, one);
  const double least = (columns * x - one).squaredNorm();
  return least < 1 ? std::sqrt(least / (1 - least)) : 1;
}

template <class Contact>
ForceSignature Signature(const std::vector<Contact>& contacts, double friction, int sides) {
  ASSAY_CHECK(friction >= 0 && sides >= 3);
  std::vector<Wrench> rays;
  for (const Contact& contact : contacts) {
    if (friction == 0) {
      rays.push_back(OfForce(contact, contact.normal));
      continue;
    }
    const Vector3 x = contact.normal.unitOrthogonal();
    const Vector3 y = contact.normal.cross(x);
    // The sides of the pyramid touch the cone, and its edges are outside of it.
    const double slope = friction / std::cos(std::numbers::pi / sides);
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * std::numbers::pi * side / sides;
      rays.push_back(
          OfForce(contact, contact.normal + slope * (std::cos(angle) * x + std::sin(angle) * y)));
    }
  }
  ForceSignature signature;
  signature.rays.resize(kPoseDimensions, static_cast<Eigen::Index>(rays.size()));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    signature.rays.col(static_cast<Eigen::Index>(i)) = rays[i];
  }
  return signature;
}

Rays Together(const Rays& a, const Rays& b) {
  Rays both(kPoseDimensions, a.cols() + b.cols());
  both << a, b;
  return both;
}

}  // namespace

ForceSignature SignatureOf(const std::vector<PrimitiveContact>& contacts, double friction,
                           int sides) {
  return Signature(contacts, friction, sides);
}

ForceSignature SignatureOf(const std::vector<plan::StrategyContact>& contacts, double friction,
                           int sides) {
  return Signature(contacts, friction, sides);
}

double Separation(const Wrench& wrench, const ForceSignature& signature, double length) {
  ASSAY_CHECK(wrench.norm() > 0);
  const Eigen::VectorXd direction = Compared(wrench, length);
  const Eigen::MatrixXd rays = Compared(signature.rays, length);
  if (rays.cols() == 0) return 1;
  return (rays * numeric::NonnegativeLeastSquares(rays, direction) - direction).norm();
}

double Separation(const ForceSignature& a, const ForceSignature& b, double length) {
  if (a.rays.cols() == 0 || b.rays.cols() == 0) return 1;
  const Rays of_a = Compared(a.rays, length);
  const Rays of_b = Compared(b.rays, length);
  return std::min(DistanceOfMeans(of_a, of_b), DistanceOfMeans(of_b, of_a));
}

double SeparationOfStates(const ForceSignature& common, const ForceSignature& only_a,
                          const ForceSignature& only_b, double length) {
  const Rays in_both = Compared(common.rays, length);
  const Rays of_a = Compared(only_a.rays, length);
  const Rays of_b = Compared(only_b.rays, length);
  double least = 1;
  for (const auto& [only, other] : {std::pair(of_a, of_b), std::pair(of_b, of_a)}) {
    const Rays rest = Together(in_both, other);
    if (only.cols() > 0 && rest.cols() > 0) least = std::min(least, DistanceOfMeans(only, rest));
  }
  return least;
}

bool Jams(const ForceSignature& signature, const Wrench& applied, double length) {
  return Separation(-applied, signature, length) < kSameWrench;
}

bool Wedges(const ForceSignature& signature, double length) {
  if (signature.rays.cols() == 0) return false;
  return DistanceOfMeans(Compared(signature.rays, length), Rays(kPoseDimensions, 0)) < kSameWrench;
}

}  // namespace assay::finemotion
