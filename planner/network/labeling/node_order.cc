#include "planner/network/labeling/node_order.h"

#include <limits>
#include <utility>

namespace assay::network {

OpenNodes::OpenNodes(std::vector<int> scope, const LabelStore& labels, const ArcConsistency& arcs)
    : labels_(labels),
      arcs_(arcs),
      scope_(std::move(scope)),
      nodes_(scope_),
      places_(labels.node_count(), std::numeric_limits<int>::max()),
      weights_(labels.node_count(), 0) {
  for (int place = 0; place < std::ssize(nodes_); ++place) places_[nodes_[place]] = place;
  Reopen(static_cast<int>(nodes_.size()));
}

void OpenNodes::Update() {
  for (int place = 0; place < count_;) {
    const int node = nodes_[place];
    if (labels_.count(node) > 1) {
      ++place;
      continue;
    }
    Swap(place, --count_);
    for (const ArcConsistency::Direction& direction : arcs_.at(node)) {
      weights_[direction.revised] -= arcs_.weight(direction.arc);
    }
  }
}

void OpenNodes::Reopen(int count) {
  for (; count_ < count; ++count_) {
    for (const ArcConsistency::Direction& direction : arcs_.at(nodes_[count_])) {
      weights_[direction.revised] += arcs_.weight(direction.arc);
    }
  }
}

void OpenNodes::Swap(int place, int other) {
  std::swap(nodes_[place], nodes_[other]);
  places_[nodes_[place]] = place;
  places_[nodes_[other]] = other;
}

void OpenNodes::Blame(const ArcConsistency::WipeOut& wipe_out) {
  if (IsOpen(wipe_out.changed)) ++weights_[wipe_out.revised];
  if (IsOpen(wipe_out.revised)) ++weights_[wipe_out.changed];
}

int OpenNodes::First() const {
  for (int node : scope_) {
    if (labels_.count(node) > 1) return node;
  }
  return -1;
}

int OpenNodes::Heaviest() const {
  int best = -1;
  std::int64_t best_count = 0, best_weight = 0;
  for (int place = 0; place < count_; ++place) {
    const int node = nodes_[place];
    const std::int64_t count = labels_.count(node);
    const std::int64_t weight = weights_[node];
    if (best < 0 || count * best_weight < best_count * weight) {
      best = node;
      best_count = count;
      best_weight = weight;
    }
  }
  return best;
}

}  // namespace assay::network
