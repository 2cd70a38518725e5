#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// The convex polyhedral set { z : rows z = values, limits } as characteristic point + nonnegative
// multiples of rays + any multiples of tangents (Dakin and Popplestone, equation 2). Tangents are
// orthonormal and orthogonal to all normals; ray i is orthogonal to every other limit's normal and
// to the tangents, unit, and leads inside limit i. Limits whose normals depend on the earlier ones'
// (both ends of a narrow face) have no ray; the cone takes no notice of them.
struct ConeForm {
  GeneralizedPoint characteristic_point;
  Eigen::MatrixXd rays;      // a column each
  Eigen::MatrixXd tangents;  // a column each
  std::vector<int> limits;   // of which the rays are
};

// Dependent rows are allowed if they agree (checked).
ConeForm ConeFormOf(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values,
                    const std::vector<HalfSpace>& limits);

}  // namespace assay::finemotion
