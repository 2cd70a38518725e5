#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/tree/plan_tree.h"
#include "planner/contingent/tree/tree_check_result.h"

namespace assay::contingent {

struct TreeCheckOptions {
  // So many initial worlds are run at most; of more, as many are drawn, unless they can be run as
  // sets (symbolic_check.h) and that tells whether the tree holds.
  std::int64_t worlds = 200'000;
  std::uint64_t seed = 1;
};

// Runs a plan tree in every world that the initial knowledge allows. Shares nothing with the
// planner but the ground task: a world says of every atom whether it is true, what is known is what
// is true in all worlds with the same history, and branches tell histories apart. In each: the
// preconditions of actions hold when they are executed, branches ask what has been sensed, and the
// goal holds at the leaves. What init and actions leave open (an atom that nothing is said of, one
// that is forgotten) is both, as soon as it matters. A repeat must come back to worlds that it
// began with; where knowing more may hurt, it is run again with all knowledge that comes back.
// Numeric functions take the ends of their intervals, the bounds that are asked, carried back to
// where the number was another one, and values beside these (number_marks.h): in most tasks they
// stand for all numbers. Knowledge that allows no world holds nothing: not at first, nor after a
// step.
//
// !K(l) holds if l is false in some world with the same history; !Kw and !Kv, if besides it has not
// been sensed. What has been sensed becomes known where the tree branches on it, not before. A
// knowledge base may know less than is true in all these worlds (it forgets how intervals hang
// together): a tree that relies on its not knowing that is rejected, and an effect under such a
// condition does not happen.
// A sample, of worlds or of their numbers, can show that something is not known, never that it is:
// preconditions and goals that ask it pass where all of the sample agree, effects and update rules
// that do fail.
TreeCheck CheckTree(const GroundTask& task, const PlanTree& tree,
                    const TreeCheckOptions& options = {});

}  // namespace assay::contingent
