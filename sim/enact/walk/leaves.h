#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/contingent/tree/plan_tree.h"
#include "sim/enact/walk/interpretation.h"
#include "sim/enact/walk/tree_walk.h"

namespace assay::enact {

// A path through a plan tree that ends at a leaf or at a repeat. It holds the branches on the path
// and the conditions that they state.
struct Leaf {
  std::vector<TakenBranch> branches;
  std::vector<contingent::GroundLiteral> literals;
  std::vector<std::vector<contingent::GroundLiteral>> denied;  // conjunctions that are false
  std::vector<contingent::Bound> bounds;
  bool is_repeat = false;  // the path ends where the tree repeats

  // Returns the branches in words, like "isSpillable(can1), !isSpillable(can2)", or "always" if
  // there are none. A repeat has ", and again" at its end.
  std::string Text() const;
  // Returns whether the walk ended at this leaf or, for a repeat, took the branches of this path.
  bool IsOn(const Walk& walk) const;
};

// Returns the leaves and repeats of the unfolded tree in the order of the tree, at most `most` of
// them. Repeats are not followed.
std::vector<Leaf> LeavesOf(const contingent::GroundTask& task, const contingent::PlanTree& tree,
                           std::size_t most);

// Draws a hidden world that should lead to the leaf. If there is none, returns the reason in words:
// for example, no kind of a part agrees with the conditions of the leaf. Whether there is a world
// does not depend on the random numbers. For an error that a plan's verification signals, the world
// gets a fault (MishapFor). Only the walk shows whether the fault causes the error.
std::variant<HiddenWorld, std::string> FindWorld(const Leaf& leaf,
                                                 const Interpretation& interpretation,
                                                 const domain::Problem& problem,
                                                 RandomStream& random);
// Draws a world as FindWorld does; none if there is no world for the leaf.
std::optional<HiddenWorld> WorldFor(const Leaf& leaf, const Interpretation& interpretation,
                                    const domain::Problem& problem, RandomStream& random);

}  // namespace assay::enact
