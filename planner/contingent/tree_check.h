#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/contingent/ground_task.h"
#include "planner/contingent/plan_tree.h"

namespace assay::contingent {

struct TreeCheckOptions {
  // So many initial worlds are run at most; of more, as many are drawn, unless they can be run as
  // sets (symbolic_check.h) and that shows that the tree holds.
  std::int64_t worlds = 200'000;
  std::uint64_t seed = 1;
};

struct TreeCheck {
  bool holds = false;
  // If not: what fails, where in the tree, and in which world.
  std::string failure;
  std::int64_t worlds = 0;        // that were run to a leaf; as sets: initial ones
  bool are_all_worlds = true;     // else they were drawn
  std::vector<NodeId> unreached;  // nodes that no world came to
};

// Runs a plan tree in every world that the initial knowledge allows. Shares nothing with the
// planner but the ground task: a world says of every atom whether it is true, what is known is what
// is true in all worlds with the same history, and sensing tells them apart. In each: the
// preconditions of actions are known when they are executed, branches ask what has been sensed, and
// the goal is known at the leaves. What init and actions leave open (an atom that nothing is said
// of, one that is forgotten) is both, as soon as it matters. A repeat must come back to worlds that
// it began with. Numeric functions take the ends of their intervals, the bounds that are asked, and
// values between. That something is not known restricts when a plan looks, not what happens: it
// counts as true.
TreeCheck CheckTree(const GroundTask& task, const PlanTree& tree,
                    const TreeCheckOptions& options = {});

}  // namespace assay::contingent
