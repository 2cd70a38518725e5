#pragma once

#include <cstdint>

#include "planner/network/network/label_set.h"

namespace assay::network {

// The label sets of many nodes side by side, each in a lane of 16, 32 or 64 bits, in blocks as wide
// as the widest vector registers.
inline constexpr int kBlockBytes = 64;
template <class Lane>
inline constexpr int kLanesOfBlock = kBlockBytes / static_cast<int>(sizeof(Lane));

template <class Lane>
struct alignas(kBlockBytes) Block {
  Lane lanes[kLanesOfBlock<Lane>];
};

// Of one node: for each of its labels a row of blocks, with what the label supports in each lane.
template <class Lane>
struct Rows {
  const Block<Lane>* first;
  Lane labels;  // that have a row, in order
  int blocks;   // of each row
};

// Sets of lanes, lane l in bit l % 64 of word l / 64.
struct NarrowedLanes {
  Word* changed;  // lanes that lost a label are added to it
  Word* single;   // and to this those of them that are left with one label
};

inline constexpr int kNoWipeOut = -1;

// Takes from all lanes what none of the labels `left`, some of rows.labels, supports. Returns
// kNoWipeOut, or a lane that would be left empty: lanes are then in between.
template <class Lane>
using NarrowLanes = int (*)(Block<Lane>* lanes, const Rows<Lane>& rows, Word left,
                            NarrowedLanes narrowed);

// The quickest way that the processor has.
template <class Lane>
NarrowLanes<Lane> QuickestNarrowLanes();

}  // namespace assay::network
