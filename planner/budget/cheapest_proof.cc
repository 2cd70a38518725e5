#include "planner/budget/cheapest_proof.h"

#include <queue>
#include <set>
#include <utility>

namespace assay::budget {

double PriceOf(const std::vector<PriceList>& prices, const Purchase& purchase) {
  double price = 0;
  for (std::size_t i = 0; i < prices.size(); ++i) price += prices[i].offers[purchase[i]].price;
  return price;
}

std::vector<double> MultiplesOf(const std::vector<PriceList>& prices, const Purchase& purchase,
                                const std::vector<ErrorQuantity>& quantities) {
  std::vector<double> multiples(quantities.size(), 1);
  for (std::size_t i = 0; i < prices.size(); ++i) {
    for (const std::size_t of : prices[i].group.quantities)
      multiples[of] = prices[i].offers[purchase[i]].greatest / quantities[of].declared();
  }
  return multiples;
}

namespace {

class Search {
 public:
  Search(const std::vector<PriceList>& prices,
         const std::function<bool(const Purchase&)>& is_proved, int most_proofs)
      : prices_(prices), is_proved_(is_proved), most_proofs_(most_proofs) {}

  CheapestProof Run() {
    Purchase best;
    for (const PriceList& list : prices_) best.push_back(list.offers.size() - 1);
    if (!Proves(best)) return answer_;
    Purchase least = best;
    for (std::size_t i = 0; i < prices_.size(); ++i) least[i] = LeastBesideTheBest(i, best);
    return InOrderOfPrice(least);
  }

 private:
  // Returns the cheapest offer of a list that suffices beside the best offers of the others.
  std::size_t LeastBesideTheBest(std::size_t list, Purchase best) {
    for (; best[list] > 0; --best[list]) {
      Purchase cheaper = best;
      --cheaper[list];
      if (!Proves(cheaper)) break;
    }
    return best[list];
  }

  CheapestProof InOrderOfPrice(const Purchase& least) {
    using Priced = std::pair<double, Purchase>;
    std::priority_queue<Priced, std::vector<Priced>, std::greater<>> open;
    std::set<Purchase> seen = {least};
    open.emplace(PriceOf(prices_, least), least);
    while (!open.empty()) {
      const Purchase purchase = open.top().second;
      open.pop();
      if (Proves(purchase)) {
        answer_.purchase = purchase;
        return answer_;
      }
      if (answer_.proofs >= most_proofs_) break;
      for (std::size_t i = 0; i < prices_.size(); ++i) {
        Purchase better = purchase;
        if (++better[i] == prices_[i].offers.size() || !seen.insert(better).second) continue;
        open.emplace(PriceOf(prices_, better), better);
      }
    }
    answer_.is_exact = false;
    return answer_;
  }

  bool Proves(const Purchase& purchase) {
    ++answer_.proofs;
    return is_proved_(purchase);
  }

  const std::vector<PriceList>& prices_;
  const std::function<bool(const Purchase&)>& is_proved_;
  int most_proofs_;
  CheapestProof answer_;
};

}  // namespace

CheapestProof FindCheapestProof(const std::vector<PriceList>& prices,
                                const std::function<bool(const Purchase&)>& is_proved,
                                int most_proofs) {
  return Search(prices, is_proved, most_proofs).Run();
}

}  // namespace assay::budget
