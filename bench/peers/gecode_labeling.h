#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"

namespace assay::peers {

// Gecode 6.2 on a binary constraint network: one integer variable a node, one table constraint
// (Compact-Table) an arc. What the constructor does is reading: label sets and tables in Gecode's
// form. Each question then posts variables and tables in a new space and searches it.
class GecodeLabeling {
 public:
  enum class Order { kAfc, kSize, kAction, kAfcRestarts };
  static constexpr Order kOrders[] = {Order::kAfc, Order::kSize, Order::kAction,
                                      Order::kAfcRestarts};
  static std::string_view Name(Order order);  // as contestant

  explicit GecodeLabeling(const workloads::NetworkWorkload& workload);
  ~GecodeLabeling();

  LabelingAnswer First(Order order, double seconds) const;
  CountAnswer Count(Order order, double seconds) const;  // not with restarts

  // Arcs are posted one by one, in order; one that leaves no labeling is taken back. Whether each
  // was accepted; shorter than the arcs when the time was up. The space with what was accepted is
  // kept and cloned for each question, so that nothing is posted or propagated twice.
  std::vector<Outcome> PostArcByArc(Order order, double seconds) const;

  // A question that may be asked again and again while this lives: whether a labeling is left with
  // the last arc. A space with all others is kept; the last one is posted into a clone of it, which
  // is dropped after the answer.
  std::function<Outcome()> AskForLastArc(Order order, double seconds) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace assay::peers
