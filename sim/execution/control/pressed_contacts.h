#pragma once

#include <vector>

#include "planner/plan/data/strategy.h"
#include "sim/execution/control/soft_arm.h"

namespace assay::execution {

// Contacts that are kept by force, and how a wrench on the part is shared among them. A contact's
// row J = (n, r x n) is the direction of its force. By the principle of virtual work, the same row
// times a twist is the speed at which the twist opens the contact. Twists and wrenches are about
// the tip, in the fixed part's axes.
class PressedContacts {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  explicit PressedContacts(std::vector<plan::StrategyContact> contacts);

  const std::vector<plan::StrategyContact>& contacts() const { return contacts_; }
  bool empty() const { return contacts_.empty(); }
  const Rows& rows() const { return rows_; }

  // Returns the least twist that changes the gaps by `gaps`. A turn of one radian counts as a shift
  // of plan::kTurnLever.
  Vector6 Opening(const Eigen::VectorXd& gaps) const;
  // Returns the force of each contact in newtons, as far as a wrench distinguishes the contacts.
  Eigen::VectorXd Forces(const Vector6& wrench) const;
  // Returns the force in newtons that the contacts do not bear, friction included.
  double Unexplained(const Vector6& wrench) const;
  // Moves the contacts so that they explain a share of the torque that is unexplained at their
  // present places. Nearly parallel edges touch far from where they would without errors.
  void Locate(const Vector6& wrench, double share);

 private:
  void SetRows();
  // Returns the wrench without the friction. The friction is assumed to act at the mean place of
  // the contacts, weighted by their forces.
  Vector6 WithoutFriction(const Vector6& wrench) const;
  Eigen::VectorXd LeastSquares(const Vector6& wrench) const;

  std::vector<plan::StrategyContact> contacts_;
  Rows rows_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> give_;  // W J', where W are the weights of twists
  Eigen::LDLT<Eigen::MatrixXd> opening_;           // decomposition of J W J'
};

}  // namespace assay::execution
