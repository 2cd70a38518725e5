#pragma once

#include <map>
#include <span>
#include <string>

#include "sim/execution/control/pressed_contacts.h"

namespace assay::execution {

// The contacts of a strategy at the places where they were found. A contact keeps its name from
// motion to motion, and its distance from the planned place.
class FoundContacts {
 public:
  // `strategy` must outlive this object. Every contact begins at its planned place.
  explicit FoundContacts(const plan::Strategy& strategy) : strategy_(strategy) {}

  const plan::StrategyContact& Planned(int contact) const;
  // Returns the contacts with these indices where they were found.
  PressedContacts Pressed(std::span<const int> contacts) const;
  // Returns the strategy with its contacts where they were found.
  plan::Strategy Strategy() const;
  // Stores where these contacts, which are indices, were found.
  void Remember(std::span<const int> contacts, const PressedContacts& pressed);

 private:
  Vector3 Beside(const plan::StrategyContact& planned) const;

  const plan::Strategy& strategy_;
  std::map<std::string, Vector3> beside_;  // the contacts' distances from their places, by name
};

}  // namespace assay::execution
