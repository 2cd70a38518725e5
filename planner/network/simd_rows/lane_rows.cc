#include "planner/network/simd_rows/lane_rows.h"

#include <algorithm>
#include <bit>

namespace assay::network {

std::vector<int> LanesOf(std::span<const int> scope, int node_count) {
  std::vector<int> lane_of(node_count, kNoLane);
  for (std::size_t lane = 0; lane < scope.size(); ++lane) {
    lane_of[scope[lane]] = static_cast<int>(lane);
  }
  return lane_of;
}

template <class Lane>
LaneRows<Lane>::LaneRows(std::span<const int> scope, std::span<const int> lane_of,
                         const LabelStore& labels, const ArcConsistency& arcs)
    : blocks_((static_cast<int>(scope.size()) + kLanesOfBlock<Lane> - 1) / kLanesOfBlock<Lane>),
      nodes_(scope.size()) {
  std::size_t row_count = 0;
  for (int node : scope) row_count += labels.count(node);
  Block<Lane> all;
  std::ranges::fill(all.lanes, static_cast<Lane>(~Lane{0}));
  blocks_of_rows_.assign(row_count * blocks_, all);
  Block<Lane>* first = blocks_of_rows_.data();
  for (std::size_t lane = 0; lane < scope.size(); ++lane) {
    const int node = scope[lane];
    const auto present = static_cast<Lane>(labels.OneWord(node));
    nodes_[lane].rows = {.first = first, .labels = present, .blocks = blocks_};
    AddRows(static_cast<int>(lane), node, lane_of, arcs, first);
    first += labels.count(node) * blocks_;
  }
}

template <class Lane>
void LaneRows<Lane>::AddRows(int lane, int node, std::span<const int> lane_of,
                             const ArcConsistency& arcs, Block<Lane>* first) {
  constexpr int kLanes = kLanesOfBlock<Lane>;
  Node& at = nodes_[lane];
  const auto for_each_label = [&](int other, const auto& supported) {
    Block<Lane>* block = first + other / kLanes;
    for (Word rest = at.rows.labels; rest != 0; rest &= rest - 1, block += blocks_) {
      block->lanes[other % kLanes] &= static_cast<Lane>(supported(std::countr_zero(rest)));
    }
  };
  for_each_label(lane, [](Label label) { return BitOf(label); });
  for (const ArcConsistency::Direction& direction : arcs.at(node)) {
    const int other = lane_of[direction.revised];
    if (other == kNoLane) continue;
    ++at.degree;
    at.most_unsupporting = std::max(at.most_unsupporting, direction.most_unsupporting);
    for_each_label(other, [&](Label label) { return direction.supported[label]; });
  }
}

template class LaneRows<std::uint16_t>;
template class LaneRows<std::uint32_t>;
template class LaneRows<std::uint64_t>;

}  // namespace assay::network
