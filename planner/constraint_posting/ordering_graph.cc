#include "planner/constraint_posting/ordering_graph.h"

#include <algorithm>

#include "planner/base/check.h"

namespace assay::constraint_posting {

StepId OrderingGraph::AddStep() {
  for (auto& row : after_) row.push_back(false);
  after_.emplace_back(after_.size() + 1, false);
  return StepId(after_.size() - 1);
}

bool OrderingGraph::Before(StepId a, StepId b) const { return after_[a.index()][b.index()]; }

bool OrderingGraph::Post(StepId a, StepId b) {
  if (a == b || Before(b, a)) return false;
  if (Before(a, b)) return true;
  arcs_.emplace_back(a, b);
  for (int x = 0; x < step_count(); ++x) {
    if (x != a.index() && !after_[x][a.index()]) continue;
    for (int y = 0; y < step_count(); ++y) {
      if (y == b.index() || after_[b.index()][y]) after_[x][y] = true;
    }
  }
  return true;
}

namespace {

// Extends `prefix` in every way by steps whose predecessors are all in it.
class LinearizationSearch {
 public:
  LinearizationSearch(const OrderingGraph& graph, int most)
      : graph_(graph), most_(most), placed_(graph.step_count(), false) {}

  std::vector<std::vector<StepId>> Run() {
    Extend();
    return std::move(found_);
  }

 private:
  bool Ready(StepId step) const {
    for (int other = 0; other < graph_.step_count(); ++other) {
      if (!placed_[other] && graph_.Before(StepId(other), step)) return false;
    }
    return true;
  }

  void Extend() {
    if (static_cast<int>(found_.size()) == most_) return;
    if (static_cast<int>(prefix_.size()) == graph_.step_count()) {
      found_.push_back(prefix_);
      return;
    }
    for (int s = 0; s < graph_.step_count(); ++s) {
      if (placed_[s] || !Ready(StepId(s))) continue;
      placed_[s] = true;
      prefix_.emplace_back(s);
      Extend();
      prefix_.pop_back();
      placed_[s] = false;
    }
  }

  const OrderingGraph& graph_;
  int most_;
  std::vector<bool> placed_;
  std::vector<StepId> prefix_;
  std::vector<std::vector<StepId>> found_;
};

}  // namespace

std::vector<std::vector<StepId>> OrderingGraph::Linearizations(int most) const {
  return LinearizationSearch(*this, most).Run();
}

}  // namespace assay::constraint_posting
