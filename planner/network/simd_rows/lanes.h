#pragma once

#include <cstdint>

#include "planner/network/constraint_network/label_set.h"

namespace assay::network {

// A SIMD row holds the label sets of many nodes. Each set is one element (Lane) of 16, 32 or 64
// bits. Elements are grouped in blocks as wide as the widest vector registers.
inline constexpr int kBlockBytes = 64;
template <class Lane>
inline constexpr int kLanesOfBlock = kBlockBytes / static_cast<int>(sizeof(Lane));

template <class Lane>
struct alignas(kBlockBytes) Block {
  Lane lanes[kLanesOfBlock<Lane>];
};

// The rows of one node: for each of its labels, what the label supports at every node.
template <class Lane>
struct Rows {
  const Block<Lane>* first;
  Lane labels;  // the labels that have a row, in order
  int blocks;   // blocks in each row
};

// Two sets of elements. Element l is bit l % 64 of word l / 64.
struct NarrowedLanes {
  Word* changed;  // elements that lost a label are added to this set
  Word* single;   // elements that lost a label and have one left are added to this set
};

inline constexpr int kNoWipeOut = -1;

// Removes from all elements the labels that none of the labels `left` supports. `left` is a subset
// of rows.labels. Returns kNoWipeOut, or an element that would become empty. In that case the
// elements are only partly revised.
template <class Lane>
using NarrowLanes = int (*)(Block<Lane>* lanes, const Rows<Lane>& rows, Word left,
                            NarrowedLanes narrowed);

// Returns the fastest implementation that the processor supports.
template <class Lane>
NarrowLanes<Lane> QuickestNarrowLanes();

}  // namespace assay::network
