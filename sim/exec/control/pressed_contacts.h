#pragma once

#include <vector>

#include "planner/plan/data/strategy.h"
#include "sim/exec/control/soft_arm.h"

namespace assay::exec {

// Contacts that are kept by force, and what a wrench on the part tells of them. A contact's row
// J = (n, r x n) is both the direction of its force and, by the principle of virtual work, the
// speed at which a twist opens it. Twists and wrenches are about the tip, in the fixed part's axes.
class PressedContacts {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  explicit PressedContacts(std::vector<plan::StrategyContact> contacts);

  const std::vector<plan::StrategyContact>& contacts() const { return contacts_; }
  bool empty() const { return contacts_.empty(); }
  const Rows& rows() const { return rows_; }

  // The twist of this change of gaps that is the least, a turn of a radian being as easy as a shift
  // of plan::kTurnLever.
  Vector6 Opening(const Eigen::VectorXd& gaps) const;
  // What each contact bears, newtons, as far as a wrench can tell them apart.
  Eigen::VectorXd Forces(const Vector6& wrench) const;
  // The force that they do not bear, friction and all, newtons.
  double Unexplained(const Vector6& wrench) const;
  // Edges that are nearly parallel touch far from where they would without errors. Contacts are
  // moved so that a share of the torque which they do not explain is explained.
  void Locate(const Vector6& wrench, double share);

 private:
  void SetRows();
  // Without the friction, as if it acted where the contacts are pressed.
  Vector6 WithoutFriction(const Vector6& wrench) const;
  Eigen::VectorXd LeastSquares(const Vector6& wrench) const;

  std::vector<plan::StrategyContact> contacts_;
  Rows rows_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> give_;  // W J'
  Eigen::LDLT<Eigen::MatrixXd> opening_;           // J W J'
};

}  // namespace assay::exec
