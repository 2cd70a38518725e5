#pragma once

#include <Eigen/Core>

namespace assay::finemotion {

// A point of generalized contact space: displacement d of the moving part (3, metres), small
// rotation w about its origin (3, radians; both in the stationary part's axes), then one dimension
// for each tolerance (metres) (Dakin and Popplestone, section 3). 0: as planned, without errors.
using GeneralizedPoint = Eigen::VectorXd;
inline constexpr int kPoseDimensions = 6;

}  // namespace assay::finemotion
