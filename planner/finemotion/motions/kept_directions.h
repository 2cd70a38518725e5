#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/finemotion/contacts/parallel_edges.h"
#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/motions/believed_pose.h"

namespace assay::finemotion {

// The directions of the kept contacts' gaps, along which force control allows no motion. They are
// orthonormal, with rotations times the radius as lengths. Each direction has the shift that
// tolerances cause.
class KeptDirections {
 public:
  KeptDirections(const std::vector<const PrimitiveContact*>& kept,
                 const Eigen::VectorXd& tolerances, double radius)
      : tolerances_(tolerances) {
    lengths_ << 1, 1, 1, radius, radius, radius;
    shifts_.resize(tolerances.size(), kPoseDimensions);
    for (const PrimitiveContact* contact : kept) Add(*contact);
  }

  // Returns whether errors of the model can open some of the contacts when others are closed.
  bool are_parted() const { return are_parted_; }

  // Rewrites the point's coordinates so that they are constant where the contacts make them
  // constant. This holds even along a motion that keeps contacts to first order only.
  void TakeOut(PointAtEdge& point) const {
    for (int i = 0; i < count_; ++i) {
      const PoseChange row = lengths_.cwiseProduct(basis_.col(i));
      const Vector3 along = point.pose * lengths_.cwiseInverse().cwiseProduct(basis_.col(i));
      point.offset -= offsets_[i] * along;
      point.pose -= along * row.transpose();
      if (tolerances_.size() > 0) point.tolerances -= along * shifts_.col(i).transpose();
    }
  }

  // Returns the errors moved by the least change that closes the contacts. If `with_tolerances`,
  // the first columns belong to the tolerances too.
  PoseChanges Closed(PoseChanges errors, bool with_tolerances) const {
    if (count_ == 0) return errors;
    for (Eigen::Index j = 0; j < errors.cols(); ++j) {
      const PoseChange error = errors.col(j);
      PoseChange closing = PoseChange::Zero();
      for (int i = 0; i < count_; ++i) {
        const PoseChange direction = basis_.col(i);
        double open = direction.cwiseProduct(lengths_).dot(error);
        if (with_tolerances && j < tolerances_.size()) open += shifts_(j, i) * tolerances_[j];
        closing += open * lengths_.cwiseInverse().cwiseProduct(direction);
      }
      errors.col(j) = error - closing;
    }
    return errors;
  }

 private:
  void Add(const PrimitiveContact& contact) {
    PoseChange row = contact.row.head<kPoseDimensions>().cwiseQuotient(lengths_);
    Eigen::VectorXd shift = contact.row.tail(tolerances_.size());
    double offset = contact.offset;
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count_; ++i) {
        const double along = basis_.col(i).dot(row);
        row -= along * basis_.col(i);
        shift -= along * shifts_.col(i);
        offset -= along * offsets_[i];
      }
    }
    const double length = row.norm();
    if (length > 1e-9) {
      basis_.col(count_) = row / length;
      offsets_[count_] = offset / length;
      shifts_.col(count_++) = shift / length;
    } else if (shift.cwiseProduct(tolerances_).lpNorm<1>() > kParted) {
      are_parted_ = true;
    }
  }

  // metres by which tolerances may part kept contacts
  static constexpr double kParted = 1e-9;

  const Eigen::VectorXd& tolerances_;
  PoseChange lengths_;
  Eigen::Matrix<double, kPoseDimensions, kPoseDimensions> basis_;
  PoseChange offsets_;  // gaps along these directions at the end of the motion
  Eigen::Matrix<double, Eigen::Dynamic, kPoseDimensions> shifts_;
  int count_ = 0;
  bool are_parted_ = false;
};

}  // namespace assay::finemotion
