#include "planner/geometry/pose.h"

#include <Eigen/SVD>

#include "planner/base/check.h"

namespace assay::geometry {

Pose Translation(const Vector3& p) {
  Pose X = Pose::Identity();
  X.translation() = p;
  return X;
}

Pose Translation(double x, double y, double z) { return Translation(Vector3(x, y, z)); }

Pose RotationX(double angle) { return Pose(Eigen::AngleAxisd(angle, Vector3::UnitX())); }
Pose RotationY(double angle) { return Pose(Eigen::AngleAxisd(angle, Vector3::UnitY())); }
Pose RotationZ(double angle) { return Pose(Eigen::AngleAxisd(angle, Vector3::UnitZ())); }

Pose PoseFromColumns(const Vector3& x, const Vector3& y, const Vector3& z, const Vector3& origin) {
  Matrix3 R;
  R << x, y, z;
  ASSAY_CHECK((R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
              R.determinant() > 0);
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Pose X = Pose::Identity();
  X.linear() = svd.matrixU() * svd.matrixV().transpose();
  X.translation() = origin;
  return X;
}

double AngleBetween(const Matrix3& R_A, const Matrix3& R_B) {
  return Eigen::AngleAxisd(R_A.transpose() * R_B).angle();
}

}  // namespace assay::geometry
