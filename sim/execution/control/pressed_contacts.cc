#include "sim/execution/control/pressed_contacts.h"

#include <algorithm>

namespace assay::execution {
namespace {

constexpr double kLocatingForce = 1;  // newtons; less does not show where contacts are

}  // namespace

PressedContacts::PressedContacts(std::vector<plan::StrategyContact> contacts)
    : contacts_(std::move(contacts)) {
  SetRows();
}

void PressedContacts::SetRows() {
  rows_.resize(std::ssize(contacts_), 6);
  for (Eigen::Index i = 0; i < rows_.rows(); ++i) {
    const plan::StrategyContact& contact = contacts_[static_cast<std::size_t>(i)];
    rows_.row(i) = Joined(contact.normal, contact.at.cross(contact.normal)).transpose();
  }
  give_ = rows_.transpose();
  give_.bottomRows<3>() /= plan::kTurnLever * plan::kTurnLever;
  if (!empty()) opening_.compute(rows_ * give_);
}

Vector6 PressedContacts::Opening(const Eigen::VectorXd& gaps) const {
  if (empty()) return Vector6::Zero();
  return give_ * opening_.solve(gaps);
}

Eigen::VectorXd PressedContacts::LeastSquares(const Vector6& wrench) const {
  if (empty()) return {};
  return opening_.solve(give_.transpose() * wrench);
}

Vector6 PressedContacts::WithoutFriction(const Vector6& wrench) const {
  const Eigen::VectorXd forces = LeastSquares(wrench).cwiseMax(0);
  const double sum = forces.sum();
  if (!(sum > 0)) return wrench;
  Vector3 pressed_at = Vector3::Zero();
  Vector3 friction = wrench.head<3>();
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    const plan::StrategyContact& contact = contacts_[static_cast<std::size_t>(i)];
    pressed_at += forces[i] / sum * contact.at;
    friction -= forces[i] * contact.normal;
  }
  return wrench - Joined(friction, pressed_at.cross(friction));
}

Eigen::VectorXd PressedContacts::Forces(const Vector6& wrench) const {
  return LeastSquares(WithoutFriction(wrench));
}

double PressedContacts::Unexplained(const Vector6& wrench) const {
  if (empty()) return wrench.head<3>().norm();
  return (wrench - rows_.transpose() * LeastSquares(wrench)).head<3>().norm();
}

void PressedContacts::Locate(const Vector6& wrench, double share) {
  const Vector6 pressing = WithoutFriction(wrench);
  const Eigen::VectorXd forces = LeastSquares(pressing).cwiseMax(0);
  if (forces.sum() < kLocatingForce) return;
  const Vector3 torque = (pressing - rows_.transpose() * forces).tail<3>();
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    plan::StrategyContact& contact = contacts_[static_cast<std::size_t>(i)];
    contact.at += share * forces[i] / forces.squaredNorm() * contact.normal.cross(torque);
  }
  SetRows();
}

}  // namespace assay::execution
