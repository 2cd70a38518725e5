#pragma once

#include <cmath>

#include "planner/finemotion/contacts/placed_part.h"

namespace assay::finemotion {

// Makes the rows of linearized contacts: coefficients of a motion (d, w) of the moving part, with w
// about its origin, and of the tolerances of the model.
class LinearRows {
 public:
  // `origin` is the moving part's origin; `tolerances` is their number.
  LinearRows(const Vector3& origin, Eigen::Index tolerances)
      : origin_(origin), dimensions_(kPoseDimensions + tolerances) {}

  const Vector3& origin() const { return origin_; }

  // Returns the row direction . (d + w x r), with zeros for the tolerances.
  numeric::SmallVector Row(const Vector3& direction, const Vector3& r) const {
    numeric::SmallVector row(dimensions_);
    row.head<3>() = direction;
    row.segment<3>(3) = r.cross(direction);
    Tolerances(row).setZero();
    return row;
  }

  // Returns the row for a motion of the moving edge's line against the stationary one's, measured
  // along `direction`.
  numeric::SmallVector EdgeRow(const Vector3& direction, const Vector3& r,
                               const Placed& moving_part, const ToleratedPart::Edge& moving,
                               const ToleratedPart::Edge& stationary) const {
    numeric::SmallVector row = Row(direction, r);
    Tolerances(row) =
        Along(moving.shift, moving_part.TurnedBack(direction)) - Along(stationary.shift, direction);
    return row;
  }

  // Returns the coefficients of the tolerances.
  Eigen::Ref<Eigen::VectorXd> Tolerances(numeric::SmallVector& row) const {
    return row.tail(dimensions_ - kPoseDimensions);
  }

  // Returns how far each tolerance shifts a feature along a direction.
  static Eigen::VectorXd Along(const ToleratedPart::Shift& shift, const Vector3& direction) {
    return shift.transpose() * direction;
  }

  // Returns the limit axis . w <= rise. A rise that is no more than rounding counts as 0.
  HalfSpace TurnLimit(const Vector3& axis, double rise) const {
    HalfSpace limit{.a = Eigen::VectorXd::Zero(dimensions_),
                    .b = std::abs(rise) < kSameDirection ? 0 : rise};
    limit.a.segment<3>(3) = axis;
    return limit;
  }

 private:
  Vector3 origin_;
  Eigen::Index dimensions_;
};

}  // namespace assay::finemotion
