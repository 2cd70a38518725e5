#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "sim/enact/meanings/meaning.h"

namespace assay::enact {

// What a numeric function of the domain is in the workcell; like a predicate's meaning.
class Quantity {
 public:
  virtual ~Quantity() = default;

  // What it lacks to be one of these arguments; empty: nothing.
  virtual std::string Lacks(const Roles& roles) const = 0;
  virtual double TrueValue(const Truth& truth, const Roles& roles) const = 0;
  // By what sensors have told; none: they have told nothing of it.
  virtual std::optional<Reading> Told(const Readings& readings, const Roles& roles) const = 0;
  // Moves what they have told by so much.
  virtual void Shift(Readings& readings, const Roles& roles, double by) const = 0;
  // Keeps of what the part may be that of which it is within the interval.
  virtual void Narrow(HiddenKinds& kinds, const Interval& within) const = 0;
};

// One word of `predicates: {FUNCTION: {is: WORD}}`, a file each.
struct QuantityWord {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<const Quantity> (*read)(const Value& map);
};
extern const QuantityWord kMass;  // {is: mass}

// All of them.
std::span<const QuantityWord* const> QuantityWords();

// Null for {is: internal}. Throws InputError.
std::unique_ptr<const Quantity> ReadQuantity(const Value& map);

bool Holds(const contingent::Bound& bound, double value);
// The numbers for which it holds.
Interval WhereHolds(const contingent::Bound& bound);
// By a reading; none: its error leaves it open.
std::optional<bool> Told(const contingent::Bound& bound, const Reading& reading);

}  // namespace assay::enact
