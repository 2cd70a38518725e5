#include "planner/network/simd_rows/lanes.h"

#include <bit>

#include "planner/network/constraint_network/support.h"

#ifdef ASSAY_HAS_TARGETS
#include <immintrin.h>
#endif

namespace assay::network {
namespace {

template <class Lane>
int NarrowOneByOne(Block<Lane>* lanes, const Rows<Lane>& rows, Word left, NarrowedLanes narrowed) {
  constexpr int kLanes = kLanesOfBlock<Lane>;
  for (int block = 0; block < rows.blocks; ++block) {
    Lane supported[kLanes] = {};
    for (Word rest = left; rest != 0; rest &= rest - 1) {
      const int row = std::popcount(rows.labels & ((rest & -rest) - 1));
      const Lane* supports = rows.first[row * rows.blocks + block].lanes;
      for (int i = 0; i < kLanes; ++i) supported[i] |= supports[i];
    }
    for (int i = 0; i < kLanes; ++i) {
      const int lane = block * kLanes + i;
      const Lane before = lanes[block].lanes[i];
      const Lane kept = before & supported[i];
      if (kept == before) continue;
      if (kept == 0) return lane;
      lanes[block].lanes[i] = kept;
      narrowed.changed[lane / kWordBits] |= BitOf(lane);
      if (std::has_single_bit(kept)) narrowed.single[lane / kWordBits] |= BitOf(lane);
    }
  }
  return kNoWipeOut;
}

#ifdef ASSAY_HAS_TARGETS
#define ASSAY_WIDE __attribute__((target("avx512bw,bmi2")))

// These functions work on elements of the first argument's type. Differ marks the elements in which
// a and b differ, and AreDisjoint the elements in which they have no bit in common. LessOne
// subtracts one; a set with one label has no bit in common with the result.
ASSAY_WIDE inline Word Differ(std::uint16_t, __m512i a, __m512i b) {
  return _mm512_cmpneq_epi16_mask(a, b);
}
ASSAY_WIDE inline Word Differ(std::uint32_t, __m512i a, __m512i b) {
  return _mm512_cmpneq_epi32_mask(a, b);
}
ASSAY_WIDE inline Word Differ(std::uint64_t, __m512i a, __m512i b) {
  return _mm512_cmpneq_epi64_mask(a, b);
}
ASSAY_WIDE inline Word AreDisjoint(std::uint16_t, __m512i a, __m512i b) {
  return _mm512_testn_epi16_mask(a, b);
}
ASSAY_WIDE inline Word AreDisjoint(std::uint32_t, __m512i a, __m512i b) {
  return _mm512_testn_epi32_mask(a, b);
}
ASSAY_WIDE inline Word AreDisjoint(std::uint64_t, __m512i a, __m512i b) {
  return _mm512_testn_epi64_mask(a, b);
}
ASSAY_WIDE inline __m512i LessOne(std::uint16_t, __m512i a) {
  return _mm512_sub_epi16(a, _mm512_set1_epi16(1));
}
ASSAY_WIDE inline __m512i LessOne(std::uint32_t, __m512i a) {
  return _mm512_sub_epi32(a, _mm512_set1_epi32(1));
}
ASSAY_WIDE inline __m512i LessOne(std::uint64_t, __m512i a) {
  return _mm512_sub_epi64(a, _mm512_set1_epi64(1));
}

// Handles several blocks at once, so that each stays in a register during the pass over the rows.
template <int kBlocks, class Lane>
ASSAY_WIDE inline int NarrowBlocks(Block<Lane>* lanes, const Rows<Lane>& rows, Word places,
                                   int block, NarrowedLanes narrowed) {
  __m512i supported[kBlocks];
  for (__m512i& each : supported) each = _mm512_setzero_si512();
  for (Word rest = places; rest != 0; rest &= rest - 1) {
    const Block<Lane>* row = rows.first + std::countr_zero(rest) * rows.blocks + block;
    for (int i = 0; i < kBlocks; ++i) {
      supported[i] = _mm512_or_si512(supported[i], _mm512_load_si512(row + i));
    }
  }
  for (int i = 0; i < kBlocks; ++i) {
    const int lane = (block + i) * kLanesOfBlock<Lane>;
    const __m512i before = _mm512_load_si512(lanes + block + i);
    const __m512i kept = _mm512_and_si512(before, supported[i]);
    const Word changed = Differ(Lane(), kept, before);
    if (changed == 0) continue;
    const Word empty = AreDisjoint(Lane(), kept, kept);
    if (empty != 0) return lane + std::countr_zero(empty);
    _mm512_store_si512(lanes + block + i, kept);
    const Word single = AreDisjoint(Lane(), kept, LessOne(Lane(), kept));
    narrowed.changed[lane / kWordBits] |= changed << lane % kWordBits;
    narrowed.single[lane / kWordBits] |= (single & changed) << lane % kWordBits;
  }
  return kNoWipeOut;
}

template <class Lane>
ASSAY_WIDE int NarrowWide(Block<Lane>* lanes, const Rows<Lane>& rows, Word left,
                          NarrowedLanes narrowed) {
  const Word places = _pext_u64(left, rows.labels);
  int block = 0;
  for (; rows.blocks - block > 4; block += 4) {
    const int wiped_out = NarrowBlocks<4>(lanes, rows, places, block, narrowed);
    if (wiped_out != kNoWipeOut) return wiped_out;
  }
  switch (rows.blocks - block) {
    case 1:
      return NarrowBlocks<1>(lanes, rows, places, block, narrowed);
    case 2:
      return NarrowBlocks<2>(lanes, rows, places, block, narrowed);
    case 3:
      return NarrowBlocks<3>(lanes, rows, places, block, narrowed);
  }
  return NarrowBlocks<4>(lanes, rows, places, block, narrowed);
}
#endif

}  // namespace

template <class Lane>
NarrowLanes<Lane> QuickestNarrowLanes() {
#ifdef ASSAY_HAS_TARGETS
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("bmi2")) {
    return NarrowWide<Lane>;
  }
#endif
  return NarrowOneByOne<Lane>;
}

template NarrowLanes<std::uint16_t> QuickestNarrowLanes();
template NarrowLanes<std::uint32_t> QuickestNarrowLanes();
template NarrowLanes<std::uint64_t> QuickestNarrowLanes();

}  // namespace assay::network
