#include "planner/contingent/knowledge/knowledge_state.h"

#include <bit>

namespace assay::contingent {

std::uint64_t HashOf(const KnowledgeState& state) {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : state.bits) hash = MixedHash(hash, word);
  for (const Diagram relation : state.relations) hash = MixedHash(hash, relation);
  for (const Range& range : state.ranges) {
    // Adding 0.0 turns -0 into 0, so that equal numbers have equal hashes.
    hash = MixedHash(hash, std::bit_cast<std::uint64_t>(range.low + 0.0));
    hash = MixedHash(hash, std::bit_cast<std::uint64_t>(range.high + 0.0));
    hash = MixedHash(hash, std::bit_cast<std::uint64_t>(range.error + 0.0));
  }
  return hash;
}

}  // namespace assay::contingent
