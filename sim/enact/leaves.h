#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/plan_tree.h"
#include "sim/enact/interpretation.h"
#include "sim/enact/tree_walk.h"

namespace assay::enact {

// A way through a plan tree to one of its leaves: the branches that lead there, and what they say
// is true.
struct Leaf {
  std::vector<TakenBranch> branches;
  std::vector<contingent::GroundLiteral> literals;

  std::string Text() const;  // "isSpillable(can1), !isSpillable(can2)"; "always"
  bool IsEndOf(const Walk& walk) const;
};

// All leaves of the tree as it unfolds, at most `most` of them; repeats are not gone. In the order
// of the tree.
std::vector<Leaf> LeavesOf(const contingent::GroundTask& task, const contingent::PlanTree& tree,
                           std::size_t most);

// A hidden world that leads to the leaf, drawn from those that do. None if there is none: what
// the leaf asks of a part, none of its kinds is.
std::optional<HiddenWorld> WorldFor(const Leaf& leaf, const Interpretation& interpretation,
                                    const domain::Problem& problem, RandomStream& random);

}  // namespace assay::enact
