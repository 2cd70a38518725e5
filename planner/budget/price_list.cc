#include "planner/budget/price_list.h"

#include <fmt/format.h>

#include <algorithm>

namespace assay::budget {
namespace {

QuantityGroup ReadGroup(const Value& name, const std::vector<ErrorQuantity>& quantities) {
  const std::optional<QuantityGroup> group = FindGroup(name.Text(), quantities);
  if (!group) {
    name.Fail(fmt::format("'{}' is no error of this scenario", name.Text()), NamesOf(quantities));
  }
  return *group;
}

double FactorOf(domain::Dimension dimension, const domain::Units& units) {
  switch (dimension) {
    case domain::Dimension::kLength:
      return units.length.factor;
    case domain::Dimension::kAngle:
      return units.angle.factor;
    default:
      return 1;
  }
}

std::vector<Offer> ReadOffers(const Value& map, double factor) {
  std::vector<Offer> offers;
  for (const auto& [error, price] : map.Entries()) {
    if (!(error.Number() > 0)) error.Fail("an error on sale is not positive", "more than 0");
    if (!(price.Number() >= 0)) price.Fail("a price is negative", "0 or more");
    offers.push_back({factor * error.Number(), price.Number()});
  }
  if (offers.empty()) map.Fail("there is no offer", "{ERROR: PRICE, ...}");
  std::ranges::sort(offers, std::ranges::greater(), &Offer::greatest);
  for (std::size_t i = 1; i < offers.size(); ++i) {
    if (offers[i].price > offers[i - 1].price) continue;
    map.Fail("a smaller error is not dearer than a greater one", "only offers that are worth it");
  }
  return offers;
}

}  // namespace

std::vector<PriceList> ReadPrices(const Value& prices, const domain::Units& units,
                                  const std::vector<ErrorQuantity>& quantities) {
  std::vector<PriceList> lists;
  std::vector<std::size_t> on_sale;
  for (const auto& [name, offers] : prices.Entries()) {
    PriceList list = {ReadGroup(name, quantities), {}};
    for (const std::size_t of : list.group.quantities) {
      if (std::ranges::count(on_sale, of) > 0)
        name.Fail(fmt::format("'{}' is on sale twice", quantities[of].name), "each error once");
      on_sale.push_back(of);
    }
    list.offers =
        ReadOffers(offers, FactorOf(quantities[list.group.quantities.front()].dimension, units));
    lists.push_back(std::move(list));
  }
  return lists;
}

}  // namespace assay::budget
