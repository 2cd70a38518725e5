#pragma once

#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/budget/quantity_group.h"
#include "planner/domain/units/units.h"

namespace assay::budget {

// A device or a tolerance that can be bought: an error of at most `greatest` costs `price`.
struct Offer {
  double greatest = 0;  // metres, radians or a ratio
  double price = 0;
};

// The offers for a group of quantities, which are bought together. A dearer offer has a
// smaller error.
struct PriceList {
  QuantityGroup group;
  std::vector<Offer> offers;  // the cheapest first; at least one
};

// Reads a scenario's key `prices`: a map from names of quantities to maps from greatest errors to
// prices, {overhead-camera.xy: {0.3: 0, 0.1: 900}}. The letters after the dot name the coordinates
// that are bought together: x, y, z. Errors are in the units of the file. Throws InputError.
std::vector<PriceList> ReadPrices(const Value& prices, const domain::Units& units,
                                  const std::vector<ErrorQuantity>& quantities);

}  // namespace assay::budget
