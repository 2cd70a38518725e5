#pragma once

#include <cstdint>
#include <string>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

enum class Guarantee {
  // the tree reaches the goal in every world that the initial knowledge allows; its size has no
  // guarantee
  kReachesGoal,
  kLeastDepth,  // the tree reaches the goal, and no tree has fewer actions on its longest path
  // The tree has repeats. Such a tree reaches the goal if no outcome of sensing is avoided for
  // ever. There is no plan without repeats.
  kIfFair,
};

struct ContingentPlan {
  Outcome outcome = Outcome::kNone;
  PlanTree tree;  // valid if the outcome is kFound
  Guarantee guarantee = Guarantee::kReachesGoal;
  std::int64_t states = 0;  // the number of knowledge states that were met
  // The reason for the outcome kBudget if the search was completed but proves nothing. It is empty
  // if the budget was spent.
  std::string doubt = {};
};

enum class Wanted {
  kFirst,  // the first tree found, by a fast search
  // The tree of least depth. The search visits all states that are near enough, so it is for small
  // problems.
  kLeastDepth,
};

// Plans at the knowledge level (Petrick and Bacchus 2002). Each visit of a knowledge state takes
// one unit of the budget.
//
// The outcome kNone is a proof. It says that no tree reaches the goal in all worlds, with or
// without repeats. If the search left out a tree that might reach the goal, the proof is a world
// from which no actions lead to the goal (hopeless_world.h). The search leaves out steps that may
// not be possible, branches on sensed values that Kx does not list, and repeats of which it cannot
// show that they end (exhaustive_tree.h). If no such world is found, nothing is proved. The outcome
// is then kBudget, and the doubt gives the reason.
//
// Throws InputError if init contradicts itself, and if update rules do not come to rest
// (knowledge_base.h).
ContingentPlan MakePlan(const GroundTask& task, Wanted wanted, Budget& budget);

}  // namespace assay::contingent
