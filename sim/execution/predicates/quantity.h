#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "sim/execution/predicates/predicate.h"

namespace assay::execution {

// The meaning of a domain's numeric function in the workcell. Predicate does the same for
// predicates.
class Quantity {
 public:
  virtual ~Quantity() = default;

  // Returns the kind of argument that the quantity needs and the function lacks, like "part"; empty
  // if nothing is missing.
  virtual std::string Lacks(const Roles& roles) const = 0;
  virtual double TrueValue(const Truth& truth, const Roles& roles) const = 0;
  // Returns the reading of the quantity; none if no sensor has read it.
  virtual std::optional<Reading> Observed(const Readings& readings, const Roles& roles) const = 0;
  // Adds `by` to the reading, which must exist.
  virtual void Shift(Readings& readings, const Roles& roles, double by) const = 0;
  // Removes those possible hidden properties of a part with which the quantity would be outside the
  // interval.
  virtual void Narrow(HiddenKinds& kinds, const Interval& within) const = 0;
};

// A word that a scenario may give in `predicates: {FUNCTION: {is: WORD}}`. Each word has its own
// source file.
struct QuantityWord {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<const Quantity> (*read)(const Value& map);
};
extern const QuantityWord kMass;  // {is: mass}

// Returns all words for quantities.
std::span<const QuantityWord* const> QuantityWords();

// Reads a map like {is: WORD}. Returns null for {is: internal}. Throws InputError.
std::unique_ptr<const Quantity> ReadQuantity(const Value& map);

// Returns whether the bound holds for the value.
bool Holds(const contingent::Bound& bound, double value);
// Returns the interval of the numbers for which the bound holds.
Interval WhereHolds(const contingent::Bound& bound);
// Returns whether the bound holds according to a reading. Returns none if the bound may or may not
// hold within the reading's error.
std::optional<bool> Observed(const contingent::Bound& bound, const Reading& reading);

}  // namespace assay::execution
