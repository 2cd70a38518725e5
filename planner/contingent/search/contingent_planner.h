#pragma once

#include <cstdint>
#include <string>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

enum class Guarantee {
  kReachesGoal,  // in every world that the initial knowledge allows; nothing is said of its size
  kLeastDepth,   // and no tree has fewer actions on its longest way
  kIfFair,       // if no outcome of sensing is put off for ever; without repeats there is no plan
};

struct ContingentPlan {
  Outcome outcome = Outcome::kNone;
  PlanTree tree;  // at kFound
  Guarantee guarantee = Guarantee::kReachesGoal;
  std::int64_t states = 0;  // knowledge states that were met
  // At kBudget: why nothing is proved though all that was looked for has been looked at. Empty: the
  // budget was spent.
  std::string doubt = {};
};

enum class Wanted {
  kFirst,       // found fast
  kLeastDepth,  // looks at all states that are near enough: for small problems
};

// Plans at the knowledge level (Petrick and Bacchus 2002). The budget is in looks at a knowledge
// state. kNone is a proof that no tree without repeats leads surely to the goal, whatever states it
// goes through, nor one with repeats of the kind that is looked for: where what a repeated branch
// asks of is open in every world anew (exhaustive_tree.h). Where the search left out a step that
// might have been taken, it proves nothing, and the answer is kBudget with a doubt. Throws
// InputError if init contradicts itself, and if update rules do not come to rest
// (knowledge_base.h).
ContingentPlan MakePlan(const GroundTask& task, Wanted wanted, Budget& budget);

}  // namespace assay::contingent
