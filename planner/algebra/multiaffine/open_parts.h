#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/algebra/multiaffine/sector.h"

namespace assay::algebra {

// The parts of a box in which a form may still exceed the best point, with the sectors of their
// variables. The part with the greatest upper bound comes first. The memory is reused from one
// question to the next.
class OpenParts {
 public:
  struct Part {
    double upper_bound = 0;
    double slack = 0;
    int polynomial = -1;  // the form as a trigonometric polynomial; -1: it is none
    int split = -1;       // the variable; -1: none can be split further
    bool has_only_ends = false;
    std::int64_t age = 0;  // breaks ties: of parts with the same bound the oldest comes first
    int sectors = 0;       // where its sectors begin

    bool operator<(const Part& other) const {
      return upper_bound != other.upper_bound ? upper_bound < other.upper_bound : age > other.age;
    }
  };

  void Clear();
  bool IsEmpty() const { return parts_.empty(); }
  const Part& Best() const { return parts_.front(); }
  // Takes the part of the box that the search should examine next. Its sectors stay until Forget.
  Part Take();
  // Adds a part and returns the place for its sectors. All parts have the same number of sectors.
  std::span<Sector> Add(Part part, std::size_t sectors);
  const Sector& SectorOf(const Part& part, std::size_t place) const {
    return sectors_[static_cast<std::size_t>(part.sectors) + place];
  }
  void Forget(const Part& part) { unused_sectors_.push_back(part.sectors); }

 private:
  std::vector<Part> parts_;  // a heap
  std::vector<Sector> sectors_;
  std::vector<int> unused_sectors_;
  std::int64_t age_ = 0;
};

}  // namespace assay::algebra
