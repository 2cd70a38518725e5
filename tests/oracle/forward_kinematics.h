#pragma once

#include <cmath>

#include "planner/kinematics/arm.h"

namespace assay::oracle {

// Returns the pose of the flange in the base as the product of the six matrices of the
// Denavit-Hartenberg table. The table has alpha = (-90, 0, 90, -90, 90, 0) degrees, and each matrix
// is written out from its definition.
inline Eigen::Matrix4d ForwardByTable(const kinematics::ArmGeometry& g,
                                      const kinematics::JointVector& q) {
  const double cosine_alpha[6] = {0, 1, 0, 0, 0, 1};
  const double sine_alpha[6] = {-1, 0, 1, -1, 1, 0};
  const double a[6] = {0, g.a2, g.a3, 0, 0, 0};
  const double d[6] = {0, g.d2, 0, g.d4, 0, g.d6};
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 6; ++i) {
    const double c = std::cos(q[i]);
    const double s = std::sin(q[i]);
    Eigen::Matrix4d A;
    A << c, -cosine_alpha[i] * s, sine_alpha[i] * s, a[i] * c,  //
        s, cosine_alpha[i] * c, -sine_alpha[i] * c, a[i] * s,   //
        0, sine_alpha[i], cosine_alpha[i], d[i],                //
        0, 0, 0, 1;
    T = T * A;
  }
  return T;
}

// Returns the pose of the flange from the URDF's joints alone, as a product of homogeneous
// matrices.
inline Eigen::Matrix4d ForwardByUrdf(const kinematics::RobotModel& model,
                                     const kinematics::JointVector& q) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 6; ++i) {
    const kinematics::Joint& joint = model.joints[static_cast<std::size_t>(i)];
    Eigen::Matrix3d cross;                        // Rodrigues' formula
    cross << 0, -joint.axis.z(), joint.axis.y(),  //
        joint.axis.z(), 0, -joint.axis.x(),       //
        -joint.axis.y(), joint.axis.x(), 0;
    Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
    turn.topLeftCorner<3, 3>() += std::sin(q[i]) * cross + (1 - std::cos(q[i])) * cross * cross;
    T = T * joint.X_ParentJoint.matrix() * turn;
  }
  return T;
}

}  // namespace assay::oracle
