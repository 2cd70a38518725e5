#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// A change of the moving part's pose: d is added to the part's origin, and the part is turned by w
// about its origin. A point of generalized space consists of such a change and of the tolerances.
using PoseChange = Eigen::Matrix<double, kPoseDimensions, 1>;
// One change in each column.
using PoseChanges = Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>;

// The believed pose of the moving part: nominally X, displaced by each errors.col(i) times any
// factor in -1 .. 1, and in contact with what it keeps. The factors of the first columns belong to
// the model's tolerances too, in multiples of their half widths.
struct BelievedPose {
  Pose X_StationaryMoving = Pose::Identity();
  PoseChanges errors;
  std::vector<ContactKey> kept = {};
  Eigen::VectorXd tolerances = {};  // half widths, metres
};

Pose Displaced(const Pose& X_StationaryMoving, const PoseChange& z);
// Returns the change that displaces `from` to `to`.
PoseChange Between(const Pose& from, const Pose& to);

// Returns the least change of a pose, after the change z, that closes the contacts' gaps to first
// order. Rotations times `radius` count as lengths.
PoseChange Closing(const std::vector<const PrimitiveContact*>& contacts, const PoseChange& z,
                   double radius);

}  // namespace assay::finemotion
