#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// The convex polyhedral set { z : rows z = values, limits } in the form of Dakin and Popplestone,
// equation 2: the characteristic point, plus nonnegative multiples of the rays, plus any multiples
// of the tangents. Tangents are orthonormal and orthogonal to all normals. Ray i is a unit vector
// that leads inside limit i and is orthogonal to the tangents and to the normal of every other
// limit. A limit whose normal depends on earlier ones (the second end of a narrow face) has no ray,
// and the cone ignores it.
struct ConeForm {
  GeneralizedPoint characteristic_point;
  Eigen::MatrixXd rays;      // one column for each ray
  Eigen::MatrixXd tangents;  // one column for each tangent
  std::vector<int> limits;   // for each ray, the index of its limit
};

// Returns the cone form of the set. Rows may depend on each other if their values agree, which is
// checked.
ConeForm ConeFormOf(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values,
                    const std::vector<HalfSpace>& limits);

}  // namespace assay::finemotion
