#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/contingent/tree/plan_tree.h"
#include "sim/enact/walk/interpretation.h"
#include "sim/enact/walk/tree_walk.h"

namespace assay::enact {

// A way through a plan tree to one of its leaves, or to where it repeats: the branches that lead
// there, and what they say is true.
struct Leaf {
  std::vector<TakenBranch> branches;
  std::vector<contingent::GroundLiteral> literals;
  std::vector<std::vector<contingent::GroundLiteral>> denied;  // not all hold, of each
  std::vector<contingent::Bound> bounds;
  bool is_repeat = false;

  // "isSpillable(can1), !isSpillable(can2)"; "always"; with ", and again" where it repeats
  std::string Text() const;
  bool IsOn(const Walk& walk) const;  // whether it came to this leaf, or repeated so
};

// All leaves and repeats of the tree as it unfolds, at most `most` of them; repeats are not gone.
// In the order of the tree.
std::vector<Leaf> LeavesOf(const contingent::GroundTask& task, const contingent::PlanTree& tree,
                           std::size_t most);

// A hidden world that is to lead to the leaf, drawn from those that do; or, in words, why there is
// none: no kind of a part, and not what is known of it, is as the leaf asks. Whether there is one
// does not depend on the random numbers. Errors that a plan's verifications signal come of faults
// (FaultFor); whether one does come of it, the walk tells.
std::variant<HiddenWorld, std::string> FindWorld(const Leaf& leaf,
                                                 const Interpretation& interpretation,
                                                 const domain::Problem& problem,
                                                 RandomStream& random);
// The same; none if there is none.
std::optional<HiddenWorld> WorldFor(const Leaf& leaf, const Interpretation& interpretation,
                                    const domain::Problem& problem, RandomStream& random);

}  // namespace assay::enact
