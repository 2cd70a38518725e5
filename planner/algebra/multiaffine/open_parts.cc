#include "planner/algebra/multiaffine/open_parts.h"

#include <algorithm>

namespace assay::algebra {

void OpenParts::Clear() {
  parts_.clear();
  sectors_.clear();
  unused_sectors_.clear();
}

OpenParts::Part OpenParts::Take() {
  const Part part = parts_.front();
  std::pop_heap(parts_.begin(), parts_.end());
  parts_.pop_back();
  return part;
}

std::span<Sector> OpenParts::Add(Part part, std::size_t sectors) {
  part.age = ++age_;
  if (unused_sectors_.empty()) {
    part.sectors = static_cast<int>(sectors_.size());
    sectors_.resize(sectors_.size() + sectors);
  } else {
    part.sectors = unused_sectors_.back();
    unused_sectors_.pop_back();
  }
  parts_.push_back(part);
  std::push_heap(parts_.begin(), parts_.end());
  return std::span(sectors_).subspan(static_cast<std::size_t>(part.sectors), sectors);
}

}  // namespace assay::algebra
