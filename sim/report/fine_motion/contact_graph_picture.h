#pragma once

#include <string>

#include "planner/finemotion/graph/contact_chain.h"
#include "sim/check/contacts/contact_sequence.h"
#include "sim/report/page/element.h"

namespace assay::report {

// A range of motions of a plan, by index.
struct MotionRange {
  std::size_t begin = 0;
  std::size_t end = 0;  // one past the last motion; equal to `begin` if the range is empty
};

// Returns an SVG drawing of the contact states at a critical point, which needs no style sheet
// (Dakin and Popplestone, figure 4). Each state is a dot, in one row for each dimension from 6
// down. A line joins two states that differ by one contact. Initial states and goals are marked.
// The states that these motions of a plan reach are joined in the plan's order and numbered by the
// motions that end in them. Some of them are not in the graph, because their contacts exist only
// for a tilted part; these have columns of their own beside the graph. A key below explains dots
// and lines and lists the contacts of the numbered states. Pointing at a state shows its contacts
// and its distance from a goal.
Element ContactGraphPicture(const finemotion::LocalTopology& topology,
                            const check::PlannedContacts& planned, const MotionRange& motions);

// Returns the contents of an SVG file of the picture.
std::string SvgFile(const Element& picture);

}  // namespace assay::report
