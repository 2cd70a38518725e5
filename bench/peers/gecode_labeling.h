#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"

namespace assay::peers {

// Asks Gecode 6.2 about a binary constraint network, with one integer variable for each node and
// one table constraint (Compact-Table) for each arc. The constructor converts label sets and tables
// to Gecode's form. Each question then posts variables and tables in a new space and searches it.
class GecodeLabeling {
 public:
  enum class Order { kAfc, kSize, kAction, kAfcRestarts };
  static constexpr Order kOrders[] = {Order::kAfc, Order::kSize, Order::kAction,
                                      Order::kAfcRestarts};
  static std::string_view Name(Order order);  // the contestant's name

  explicit GecodeLabeling(const workloads::NetworkWorkload& workload);
  ~GecodeLabeling();

  LabelingAnswer First(Order order, double seconds) const;
  CountAnswer Count(Order order, double seconds) const;  // not for kAfcRestarts

  // Posts arcs one by one, in order, and takes back those that leave no labeling. Returns for each
  // arc whether it was accepted; the result is shorter than the arcs if the time was up. The space
  // with the accepted arcs is kept and cloned for each question, so that nothing is posted or
  // propagated twice.
  std::vector<Outcome> PostArcByArc(Order order, double seconds) const;

  // Returns a question that may be asked repeatedly while this object lives: whether a labeling is
  // left with the last arc. A space with all other arcs is kept. The last arc is posted into a
  // clone of it, which is dropped after the answer.
  std::function<Outcome()> AskForLastArc(Order order, double seconds) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace assay::peers
