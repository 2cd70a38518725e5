#pragma once

#include <Eigen/Core>

#include "planner/finemotion/numeric/generalized_point.h"

namespace assay::finemotion {

// A region of uncertainty: center + sum of g_i generators.col(i), -1 <= g_i <= 1. A box, its linear
// images and sums of those are such sets; their size grows with the number of errors, where that of
// their corners is exponential in it (Dakin and Popplestone, section 5).
struct Zonotope {
  GeneralizedPoint center;
  Eigen::MatrixXd generators;  // a column each

  static Zonotope Box(const Eigen::VectorXd& low, const Eigen::VectorXd& high);

  double Support(const Eigen::VectorXd& a) const;             // the greatest a . z
  GeneralizedPoint Farthest(const Eigen::VectorXd& a) const;  // a point where a . z is greatest
};

Zonotope Mapped(const Eigen::MatrixXd& linear, const Eigen::VectorXd& offset, const Zonotope& of);
Zonotope Sum(const Zonotope& a, const Zonotope& b);
Zonotope Scaled(const Zonotope& region, double factor);  // about its center

}  // namespace assay::finemotion
