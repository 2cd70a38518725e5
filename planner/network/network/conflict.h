#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/network/network.h"

namespace assay::network {

// The node's label is one of these.
struct UnaryConstraint {
  NodeId node;
  LabelSet allowed;
};

// The pair of labels is one of the relation's.
struct BinaryConstraint {
  NodeId a, b;
  std::shared_ptr<const Relation> relation;
};

using Constraint = std::variant<UnaryConstraint, BinaryConstraint>;

// Adds the constraint without a check.
void Add(Network& network, const Constraint& constraint);

struct Conflict {
  // kFound: `constraints` is a minimal conflict. kNone: all constraints together are consistent.
  // kBudget: not known.
  Outcome outcome = Outcome::kNone;
  std::vector<int> constraints;  // indices into the list, in increasing order
};

// A minimal conflict among constraints over the nodes of `background`: together with the network
// they leave no labeling, and would leave one if any of them were left out. The conflict is empty
// if the background is inconsistent by itself. Of several minimal conflicts, one whose constraints
// stand early in the list is preferred (QuickXplain: Junker 2004).
Conflict MinimalConflict(const Network& background, std::span<const Constraint> constraints,
                         Budget& budget);

}  // namespace assay::network
