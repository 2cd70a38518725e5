#include "sim/execution/control/awaited_contact.h"

#include <algorithm>

namespace assay::execution {
namespace {

constexpr double kCreep = 0.1;  // least share of a pace: friction may hide that a contact is made

}  // namespace

AwaitedContact::AwaitedContact(int kept, double seeming, const ControlLaw& law)
    : law_(law),
      kept_(kept),
      least_(law.first_touching_force + seeming),
      felt_(Eigen::VectorXd::Zero(kept + 1)) {}

void AwaitedContact::Feel(const Eigen::VectorXd& forces, double timestep) {
  felt_ += std::min(1.0, timestep / law_.touch_filter) * (forces - felt_);
  if (kept_ > 0) pace_ = std::clamp(OfKept(forces) / (kept_ * law_.pressing_force), kCreep, 1.0);
}

double AwaitedContact::Usual() const {
  return kept_ > 0 ? law_.touching_force : law_.first_touching_force;
}

bool AwaitedContact::IsMade() const {
  const double enough = kept_ > 0 ? std::min(Usual(), OfKept(felt_)) : Usual();
  return felt_[kept_] > std::max(least_, enough);
}

bool AwaitedContact::IsApart() const { return felt_[kept_] < std::max(least_, Usual()) / 2; }

}  // namespace assay::execution
