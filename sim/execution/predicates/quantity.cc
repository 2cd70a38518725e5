#include "sim/execution/predicates/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace assay::execution {

std::span<const QuantityWord* const> QuantityWords() {
  static constexpr std::array kWords = {&kMass};
  return kWords;
}

std::unique_ptr<const Quantity> ReadQuantity(const Value& map) {
  std::vector<std::string> names = {"internal"};
  for (const QuantityWord* word : QuantityWords()) names.emplace_back(word->name);
  const int word = map.At("is").OneOf(names);
  if (word > 0) return QuantityWords()[static_cast<std::size_t>(word - 1)]->read(map);
  map.AllowOnly({"is"});
  return nullptr;
}

bool Holds(const contingent::Bound& bound, double value) {
  return SurelyHolds(bound, {.low = value, .high = value});
}

Interval WhereHolds(const contingent::Bound& bound) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double far = IsUpper(bound.relation) ? -kInfinity : kInfinity;
  const double end = IsStrict(bound.relation) ? std::nextafter(bound.value, far) : bound.value;
  return {std::min(end, far), std::max(end, far)};
}

std::optional<bool> Observed(const contingent::Bound& bound, const Reading& reading) {
  const contingent::Range range = {.low = reading.value - reading.error,
                                   .high = reading.value + reading.error};
  if (SurelyHolds(bound, range)) return true;
  if (SurelyHolds(Negation(bound), range)) return false;
  return std::nullopt;
}

}  // namespace assay::execution
