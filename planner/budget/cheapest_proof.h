#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "planner/budget/price_list.h"

namespace assay::budget {

// An index into the offers of each price list.
using Purchase = std::vector<std::size_t>;

double PriceOf(const std::vector<PriceList>& prices, const Purchase& purchase);

// Returns the multiples of all quantities that the purchase gives; 1 for what is not on sale.
std::vector<double> MultiplesOf(const std::vector<PriceList>& prices, const Purchase& purchase,
                                const std::vector<ErrorQuantity>& quantities);

struct CheapestProof {
  std::optional<Purchase> purchase;  // none: not even the best offers suffice, or the budget ended
  int proofs = 0;                    // proofs that were tried
  bool is_exact = true;              // false: the budget of proofs ended before an answer
};

// Finds a cheapest purchase with which everything is proved, by branch and bound. Purchases are
// tried in the order of their prices. A proof for some errors is a proof for all smaller errors,
// so an offer of one list that does not suffice beside the best offers of all others suffices
// nowhere, and neither do the cheaper ones of that list.
CheapestProof FindCheapestProof(const std::vector<PriceList>& prices,
                                const std::function<bool(const Purchase&)>& is_proved,
                                int most_proofs);

}  // namespace assay::budget
