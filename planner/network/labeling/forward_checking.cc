#include "planner/network/labeling/forward_checking.h"

#include <bit>

namespace assay::network {

bool ForwardChecking::Fits(const LabelStore& labels) {
  for (int node = 0; node < labels.node_count(); ++node) {
    if (!labels.IsOneWord(node) || labels.count(node) == 0) return false;
  }
  return true;
}

ForwardChecking::ForwardChecking(const LabelStore& labels, const ArcConsistency& arcs,
                                 Counters& counters)
    : arcs_(arcs), counters_(counters), labels_(labels.node_count()), open_(labels.node_count()) {
  for (int node = labels.node_count() - 1; node >= 0; --node) {
    labels_[node] = labels.OneWord(node);
    open_.Add(node, labels.count(node));
  }
  decisions_.reserve(labels_.size());
  trail_.reserve(4 * labels_.size());
}

std::optional<Outcome> ForwardChecking::Any(std::int64_t wipe_out_limit, Budget& budget) {
  const std::int64_t wipe_outs_before = counters_.wipe_outs;
  while (!open_.empty()) {
    OpenDecision();
    do {
      while (decisions_.back().untried == 0) {
        if (!CloseDecision()) return Outcome::kNone;
      }
      if (counters_.wipe_outs - wipe_outs_before > wipe_out_limit) return std::nullopt;
      if (!budget.Spend()) return Outcome::kBudget;
    } while (!TryNextLabel());
  }
  return Outcome::kFound;
}

void ForwardChecking::OpenDecision() {
  const int node = open_.First();
  open_.Remove(node);
  decisions_.push_back(
      {.node = node, .before = labels_[node], .untried = labels_[node], .trail = trail_.size()});
}

// Returns to the previous decision. Returns false if there is none.
bool ForwardChecking::CloseDecision() {
  const Decision& last = decisions_.back();
  labels_[last.node] = last.before;
  open_.Add(last.node, std::popcount(last.before));
  decisions_.pop_back();
  if (decisions_.empty()) return false;
  Undo(decisions_.back().trail);
  return true;
}

bool ForwardChecking::TryNextLabel() {
  Decision& decision = decisions_.back();
  const Label label = std::countr_zero(decision.untried);
  decision.untried &= decision.untried - 1;
  labels_[decision.node] = BitOf(label);
  ++counters_.visited;
  if (TakeUnsupported(decision.node, label)) return true;
  ++counters_.wipe_outs;
  Undo(decision.trail);
  return false;
}

// Decided nodes lose no label, because the labels that they do not support were already removed
// from this node.
bool ForwardChecking::TakeUnsupported(int node, Label label) {
  for (const ArcConsistency::Direction& direction : arcs_.at(node)) {
    ++counters_.revisions;
    const int revised = direction.revised;
    const Word before = labels_[revised];
    const Word kept = before & direction.supported[label];
    if (kept == before) continue;
    if (kept == 0) return false;
    trail_.push_back({.node = revised, .before = before});
    Replace(revised, kept);
  }
  return true;
}

void ForwardChecking::Undo(std::size_t trail) {
  for (; trail_.size() > trail; trail_.pop_back())
    Replace(trail_.back().node, trail_.back().before);
}

void ForwardChecking::Replace(int node, Word labels) {
  open_.Remove(node);
  labels_[node] = labels;
  open_.Add(node, std::popcount(labels));
}

Labeling ForwardChecking::labeling() const {
  Labeling labeling;
  labeling.labels.reserve(labels_.size());
  for (Word labels : labels_) labeling.labels.push_back(std::countr_zero(labels));
  return labeling;
}

}  // namespace assay::network
