#include "planner/network/labeling/tree_search.h"

#include <utility>

namespace assay::network {
TreeSearch::TreeSearch(LabelStore& labels, ArcConsistency& arcs, Counters& counters,
                       std::vector<int> scope, NodeOrder order)
    : labels_(labels),
      arcs_(arcs),
      counters_(counters),
      open_(std::move(scope), labels, arcs),
      order_(order),
      preferred_(labels.node_count(), kNoLabel) {}

Outcome TreeSearch::Next(Budget& budget) { return *Advance(budget, kUnlimited); }

Outcome TreeSearch::Any(Budget& budget) {
  auto limit = static_cast<double>(kFirstWipeOutLimit);
  while (true) {
    if (const auto outcome = AnyWithin(static_cast<std::int64_t>(limit), budget)) return *outcome;
    limit *= kWipeOutLimitGrowth;
  }
}

std::optional<Outcome> TreeSearch::AnyWithin(std::int64_t wipe_out_limit, Budget& budget) {
  const std::optional<Outcome> outcome = Advance(budget, wipe_out_limit);
  if (!outcome.has_value()) Rewind();
  return outcome;
}

std::optional<Outcome> TreeSearch::Advance(Budget& budget, std::int64_t wipe_out_limit) {
  const std::int64_t wipe_outs_before = counters_.wipe_outs;
  bool consistent = place_ == Place::kInside || (place_ == Place::kAtLabeling && Backtrack());
  place_ = Place::kInside;
  while (consistent) {
    if (wipe_out_limit != kUnlimited && counters_.wipe_outs - wipe_outs_before >= wipe_out_limit) {
      return std::nullopt;
    }
    const int node = ChooseNode();
    if (node < 0) {
      place_ = Place::kAtLabeling;
      return Outcome::kFound;
    }
    if (!budget.Spend()) return Outcome::kBudget;
    consistent = Descend(node) || Backtrack();
  }
  place_ = Place::kExhausted;
  return Outcome::kNone;
}

bool TreeSearch::Descend(int node) {
  const Label label = ChooseLabel(node);
  decisions_.push_back(
      {.mark = labels_.Save(), .node = node, .label = label, .open = open_.count()});
  ++counters_.visited;
  labels_.Assign(node, label);
  arcs_.Enqueue(node);
  if (!Propagate()) return false;
  preferred_[node] = label;
  return true;
}

bool TreeSearch::Backtrack() {
  while (!decisions_.empty()) {
    const Decision decision = decisions_.back();
    decisions_.pop_back();
    labels_.Undo(decision.mark);
    open_.Reopen(decision.open);
    labels_.Remove(decision.node, decision.label);
    arcs_.Enqueue(decision.node);
    if (Propagate()) return true;
  }
  return false;
}

bool TreeSearch::Propagate() {
  if (arcs_.Propagate(labels_, counters_)) return true;
  open_.Blame(arcs_.last_wipe_out());
  return false;
}

void TreeSearch::Rewind() {
  if (decisions_.empty()) return;
  labels_.Undo(decisions_.front().mark);
  open_.Reopen(decisions_.front().open);
  decisions_.clear();
}

int TreeSearch::ChooseNode() {
  if (order_ == NodeOrder::kGiven) return open_.First();
  open_.Update();
  return open_.Heaviest();
}

Label TreeSearch::ChooseLabel(int node) const {
  if (order_ == NodeOrder::kGiven) return labels_.First(node);
  const Label preferred = preferred_[node];
  return preferred != kNoLabel && labels_.Contains(node, preferred) ? preferred
                                                                    : labels_.First(node);
}

}  // namespace assay::network
