#pragma once

#include <string>

#include "planner/finemotion/contact_graph/contact_chain.h"
#include "sim/check/contact_sequences/contact_sequence.h"
#include "sim/report/html/element.h"

namespace assay::report {

// A range of motions of a plan, by index.
struct MotionRange {
  std::size_t begin = 0;
  std::size_t end = 0;  // one past the last motion; equal to `begin` if the range is empty
};

// Returns an SVG drawing of the contact states at a critical point (Dakin and Popplestone, figure
// 4). The drawing needs no style sheet. Each state is a dot. Each row holds the states of one
// dimension, with dimension 6 at the top. A line joins two states that differ by one contact.
// Initial states and goals are marked. The states that `motions` of the plan reach are joined in
// the plan's order, and each is numbered by the motion that ends in it. Some of these states are
// not in the graph, because their contacts exist only for a tilted part. These states have columns
// of their own beside the graph. A key below the graph explains dots and lines, and lists the
// contacts of the numbered states. Pointing at a state shows its contacts and its distance from a
// goal.
Element ContactGraphPicture(const finemotion::LocalTopology& topology,
                            const check::PlannedContacts& planned, const MotionRange& motions);

}  // namespace assay::report
