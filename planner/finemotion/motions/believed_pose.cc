#include "planner/finemotion/motions/believed_pose.h"

#include <Eigen/Geometry>

#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

PoseChange Closing(const std::vector<const PrimitiveContact*>& contacts, const PoseChange& z,
                   double radius) {
  PoseChange closing = PoseChange::Zero();
  if (contacts.empty()) return closing;
  Eigen::MatrixXd rows(std::ssize(contacts), kPoseDimensions);
  Eigen::VectorXd gaps(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const PrimitiveContact& contact = *contacts[static_cast<std::size_t>(i)];
    rows.row(i) = contact.row.head<kPoseDimensions>();
    gaps[i] = contact.offset + rows.row(i).dot(z);
  }
  rows.rightCols<3>() /= radius;
  closing = numeric::ShortestLeastSquares(rows, -gaps);
  closing.tail<3>() /= radius;
  return closing;
}

Pose Displaced(const Pose& X_StationaryMoving, const PoseChange& z) {
  Pose X = X_StationaryMoving;
  const Vector3 w = z.tail<3>();
  const double angle = w.norm();
  if (angle > 0) X.linear() = Eigen::AngleAxisd(angle, w / angle) * X.linear();
  X.translation() += z.head<3>();
  return X;
}

PoseChange Between(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
  PoseChange z;
  z << to.translation() - from.translation(), turn.angle() * turn.axis();
  return z;
}

}  // namespace assay::finemotion
