#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/constraint_network/network.h"

namespace assay::network {

// The label of `node` is one of `allowed`.
struct UnaryConstraint {
  NodeId node;
  LabelSet allowed;
};

// The labels of `a` and `b` are an allowed pair of the relation.
struct BinaryConstraint {
  NodeId a, b;
  std::shared_ptr<const Relation> relation;
};

using Constraint = std::variant<UnaryConstraint, BinaryConstraint>;

// Adds the constraint to the network without a consistency check.
void Add(Network& network, const Constraint& constraint);

struct Conflict {
  // kFound: `constraints` is a minimal conflict. kNone: all constraints together are consistent.
  // kBudget: the budget was spent, and nothing is known.
  Outcome outcome = Outcome::kNone;
  std::vector<int> constraints;  // indices into the given list, in increasing order
};

// Finds a minimal conflict among constraints over the nodes of `background`. Together with the
// network, the constraints of the conflict leave no labeling. If any one of them is left out, a
// labeling remains. The conflict is empty if the background is inconsistent by itself. If there are
// several minimal conflicts, constraints that are early in the list are preferred (QuickXplain:
// Junker 2004).
Conflict MinimalConflict(const Network& background, std::span<const Constraint> constraints,
                         Budget& budget);

}  // namespace assay::network
