#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/plan_tree/plan_tree.h"
#include "planner/contingent/tree_check/tree_check_result.h"

namespace assay::contingent {

struct TreeCheckOptions {
  // The greatest number of initial worlds that are run one by one. If there are more, the check
  // runs them as sets (symbolic_check.h). If sets cannot decide whether the tree holds, this number
  // of worlds is drawn.
  std::int64_t worlds = 200'000;
  std::uint64_t seed = 1;
};

// Runs a plan tree in every world that the initial knowledge allows. The check shares only the
// ground task with the planner. A world gives every atom a truth value. A fact is known if it is
// true in all worlds with the same history, and branches separate histories. The check requires
// that preconditions hold when actions are executed, that branches ask about sensed facts, and that
// the goal holds at the leaves. An atom that init or an action leaves open takes both values as
// soon as they matter. A repeat must come back to worlds in which it began. Where more knowledge
// may do harm, the repeat is run again with every knowledge that comes back. Numeric functions take
// the ends of their intervals, the bounds that are asked, carried back through assignments, and
// values beside these (number_marks.h). In most tasks these values represent all numbers. The tree
// fails if the knowledge allows no world, initially or after a step.
//
// !K(l) holds if l is false in some world with the same history. !Kw and !Kv hold if, in addition,
// the fact has not been sensed. A sensed fact becomes known where the tree branches on it, not
// before. A knowledge base may know less than is true in all these worlds, because it forgets how
// intervals depend on each other. A tree that relies on this ignorance is rejected, and an effect
// under such a condition does not happen.
//
// A sample of worlds or of their numbers can show that a fact is not known, but never that it is
// known. Preconditions and goals that ask for ignorance hold if the whole sample agrees. Effects
// and update rules that ask for ignorance fail in this case.
TreeCheck CheckTree(const GroundTask& task, const PlanTree& tree,
                    const TreeCheckOptions& options = {});

}  // namespace assay::contingent
