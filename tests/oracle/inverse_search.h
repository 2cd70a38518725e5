#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/base/random.h"
#include "planner/kinematics/inverse/serial_chain.h"

namespace assay::oracle {

using ArmAngles = Eigen::Matrix<double, 6, 1>;

// The pose of the tip, turned joint by joint from the last to the first.
inline Eigen::Matrix4d TipPose(const kinematics::SerialChain& chain, const ArmAngles& q) {
  Eigen::Affine3d X(chain.X_BaseTipAtZero().matrix());
  for (int i = 5; i >= 0; --i) {
    const kinematics::JointAxis& axis = chain.axis(i);
    X = Eigen::Translation3d(axis.point) * Eigen::AngleAxisd(q[i], axis.direction) *
        Eigen::Translation3d(-axis.point) * X;
  }
  return X.matrix();
}

inline double GreatestTurn(const ArmAngles& a, const ArmAngles& b) {
  double greatest = 0;
  for (int i = 0; i < 6; ++i) {
    greatest = std::max(greatest, std::abs(std::remainder(a[i] - b[i], 2 * std::numbers::pi)));
  }
  return greatest;
}

// Searches for solutions of the inverse kinematics by Newton's method with differences, from many
// random starts. It knows nothing of the arm's structure. It may miss solutions that few starts
// lead to.
inline std::vector<ArmAngles> SearchInverse(const kinematics::SerialChain& chain,
                                            const Eigen::Matrix4d& target, int starts,
                                            RandomStream& random) {
  const auto error = [&](const ArmAngles& q) -> Eigen::Matrix<double, 12, 1> {
    const Eigen::Matrix<double, 3, 4> difference = (TipPose(chain, q) - target).topRows<3>();
    return Eigen::Map<const Eigen::Matrix<double, 12, 1>>(difference.data());
  };
  std::vector<ArmAngles> found;
  for (int start = 0; start < starts; ++start) {
    ArmAngles q;
    for (double& angle : q) angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
    Eigen::Matrix<double, 12, 1> e = error(q);
    for (int step = 0; step < 40 && e.norm() > 1e-11 && q.allFinite(); ++step) {
      Eigen::Matrix<double, 12, 6> slope;
      for (int i = 0; i < 6; ++i) {
        ArmAngles moved = q;
        moved[i] += 1e-7;
        slope.col(i) = (error(moved) - e) / 1e-7;
      }
      ArmAngles change = slope.colPivHouseholderQr().solve(e);
      if (change.norm() > 1) change.normalize();
      q -= change;
      e = error(q);
    }
    if (!(e.norm() < 1e-9)) continue;
    const bool known = std::any_of(found.begin(), found.end(), [&](const ArmAngles& other) {
      return GreatestTurn(other, q) < 1e-4;
    });
    if (!known) found.push_back(q);
  }
  return found;
}

}  // namespace assay::oracle
