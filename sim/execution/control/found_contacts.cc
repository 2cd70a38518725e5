#include "sim/execution/control/found_contacts.h"

#include <cstddef>

namespace assay::execution {

PressedContacts FoundContacts::Pressed(std::span<const int> contacts) const {
  std::vector<plan::StrategyContact> pressed;
  for (const int index : contacts) {
    pressed.push_back(Planned(index));
    pressed.back().at += Beside(pressed.back());
  }
  return PressedContacts(pressed);
}

const plan::StrategyContact& FoundContacts::Planned(int contact) const {
  return strategy_.contacts[static_cast<std::size_t>(contact)];
}

Vector3 FoundContacts::Beside(const plan::StrategyContact& planned) const {
  const auto found = beside_.find(planned.name);
  return found == beside_.end() ? Vector3::Zero() : found->second;
}

void FoundContacts::Remember(std::span<const int> contacts, const PressedContacts& pressed) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& planned = Planned(contacts[i]);
    beside_[planned.name] = pressed.contacts()[i].at - planned.at;
  }
}

plan::Strategy FoundContacts::Strategy() const {
  plan::Strategy found = strategy_;
  for (plan::StrategyContact& contact : found.contacts) contact.at += Beside(contact);
  return found;
}

}  // namespace assay::execution
