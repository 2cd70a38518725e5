#pragma once

#include <string>

#include "planner/finemotion/graph/contact_chain.h"
#include "sim/check/contacts/contact_sequence.h"
#include "sim/report/page/element.h"

namespace assay::report {

// Motions of a plan, by index.
struct MotionRange {
  std::size_t begin = 0;
  std::size_t end = 0;  // past the last; as begin: none
};

// The contact states at a critical point as an SVG drawing that needs no style sheet: a dot for
// each, in a row for each dimension from 6 down; a line where one contact is made or broken (Dakin
// and Popplestone, figure 4). Initial states and goals are marked. States that these motions of a
// plan lead through are joined in its order and numbered by the motions that end in them. Those
// that the graph has not, since their contacts exist where the part is tilted only, stand in
// columns of their own beside it. Below stand what dots and lines mean, and the contacts of the
// states that the plan leads through, by their numbers. Pointing at a state tells its contacts and
// how far it is from a goal.
Element ContactGraphPicture(const finemotion::LocalTopology& topology,
                            const check::PlannedContacts& planned, const MotionRange& motions);

// The same as a file of its own.
std::string SvgFile(const Element& picture);

}  // namespace assay::report
