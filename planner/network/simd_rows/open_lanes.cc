#include "planner/network/simd_rows/open_lanes.h"

#include <bit>
#include <cstdint>
#include <utility>

namespace assay::network {

OpenLanes::OpenLanes(std::span<const int> scope, std::span<const int> lane_of,
                     const ArcConsistency& arcs)
    : arc_weights_(scope.size() * scope.size(), 0), weights_(scope.size(), 0) {
  for (int lane = 0; lane < std::ssize(scope); ++lane) {
    order_.push_back(lane);
    places_.push_back(lane);
    for (const ArcConsistency::Direction& direction : arcs.at(scope[lane])) {
      const int other = lane_of[direction.revised];
      if (other == kNoLane) continue;
      arc_weights_[lane * scope.size() + other] += static_cast<int>(arcs.weight(direction.arc));
    }
  }
  Reopen(static_cast<int>(scope.size()));
}

template <class Lane>
void OpenLanes::Update(const Lane* lanes) {
  for (int place = 0; place < count_;) {
    const int lane = order_[place];
    if (!std::has_single_bit(lanes[lane])) {
      ++place;
      continue;
    }
    Swap(place, --count_);
    const int* arcs = ArcsOf(lane);
    for (std::size_t other = 0; other < weights_.size(); ++other) weights_[other] -= arcs[other];
  }
}

void OpenLanes::Reopen(int count) {
  for (; count_ < count; ++count_) {
    const int* arcs = ArcsOf(order_[count_]);
    for (std::size_t other = 0; other < weights_.size(); ++other) weights_[other] += arcs[other];
  }
}

void OpenLanes::Swap(int place, int other) {
  std::swap(order_[place], order_[other]);
  places_[order_[place]] = place;
  places_[order_[other]] = other;
}

void OpenLanes::Blame(int changed, int revised) {
  ++arc_weights_[changed * places_.size() + revised];
  ++arc_weights_[revised * places_.size() + changed];
  if (IsOpen(changed)) ++weights_[revised];
  if (IsOpen(revised)) ++weights_[changed];
}

template <class Lane>
int OpenLanes::Heaviest(const Lane* lanes) const {
  int best = -1;
  std::int64_t best_square = 0, best_weight = 0;
  for (int place = 0; place < count_; ++place) {
    const int lane = order_[place];
    const std::int64_t count = std::popcount(lanes[lane]), square = count * count;
    const std::int64_t weight = weights_[lane];
    if (best < 0 || square * best_weight < best_square * weight) {
      best = lane;
      best_square = square;
      best_weight = weight;
    }
  }
  return best;
}

template void OpenLanes::Update(const std::uint16_t* lanes);
template void OpenLanes::Update(const std::uint32_t* lanes);
template void OpenLanes::Update(const std::uint64_t* lanes);
template int OpenLanes::Heaviest(const std::uint16_t* lanes) const;
template int OpenLanes::Heaviest(const std::uint32_t* lanes) const;
template int OpenLanes::Heaviest(const std::uint64_t* lanes) const;

}  // namespace assay::network
