#pragma once

#include <Eigen/Core>

namespace assay::geometry {

// A region of uncertainty: the points center + sum of g_i generators.col(i) with -1 <= g_i <= 1.
// Boxes, linear images of boxes, and sums of these images are zonotopes. The size of a zonotope
// grows linearly with the number of errors, while the number of its corners grows exponentially
// (Dakin and Popplestone, section 5).
struct Zonotope {
  Eigen::VectorXd center;
  Eigen::MatrixXd generators;  // one column for each error

  static Zonotope Box(const Eigen::VectorXd& low, const Eigen::VectorXd& high);

  double Support(const Eigen::VectorXd& a) const;  // returns the greatest value of a . z
  // Returns a point where a . z is greatest.
  Eigen::VectorXd Farthest(const Eigen::VectorXd& a) const;
};

}  // namespace assay::geometry
