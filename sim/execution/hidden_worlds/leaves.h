#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/contingent/plan_tree/plan_tree.h"
#include "sim/execution/interpretation/interpretation.h"
#include "sim/execution/walk/tree_walk.h"

namespace assay::execution {

// A path through a plan tree that ends at a leaf or at a repeat. It holds the branches on the path
// and the conditions that they state.
struct Leaf {
  std::vector<TakenBranch> branches;
  std::vector<contingent::GroundLiteral> literals;
  std::vector<std::vector<contingent::GroundLiteral>> denied;  // conjunctions that are false
  std::vector<contingent::Bound> bounds;
  bool is_repeat = false;

  // Returns the branches in words, like "isSpillable(can1), !isSpillable(can2)", or "always" if
  // there are none. A repeat has ", and again" at its end.
  std::string Text() const;
  bool IsOn(const Walk& walk) const;
};

// Returns the leaves and repeats of the unfolded tree in the order of the tree, at most `most` of
// them. Repeats are not followed.
std::vector<Leaf> LeavesOf(const contingent::GroundTask& task, const contingent::PlanTree& tree,
                           std::size_t most);

// Draws a hidden world that should lead to the leaf. Returns, in words, the reason if there is
// none: no kind of a part is as the leaf asks, or what is known about the part contradicts the
// leaf. The random numbers do not decide whether a world exists. If the leaf lies behind an error
// that a verification signals, the world has a fault that may cause the error (FaultFor). Only the
// walk shows whether the fault does cause it.
std::variant<HiddenWorld, std::string> FindWorld(const Leaf& leaf,
                                                 const Interpretation& interpretation,
                                                 const domain::Problem& problem,
                                                 RandomStream& random);
// Draws a world as FindWorld does. Returns none if there is no world for the leaf.
std::optional<HiddenWorld> WorldFor(const Leaf& leaf, const Interpretation& interpretation,
                                    const domain::Problem& problem, RandomStream& random);

}  // namespace assay::execution
