#pragma once

#include <Eigen/Core>

namespace assay::finemotion {

// A point of generalized configuration space (Dakin and Popplestone, section 3). Its coordinates
// are the displacement d of the moving part (3, metres), a small rotation w about its origin (3,
// radians), and one coordinate for each model tolerance (metres). d and w are in the stationary
// part's axes. The point 0 is the planned pose without errors.
using GeneralizedPoint = Eigen::VectorXd;
inline constexpr int kPoseDimensions = 6;

}  // namespace assay::finemotion
