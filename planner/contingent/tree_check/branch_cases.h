#pragma once

#include <string>
#include <vector>

#include "planner/contingent/plan_tree/plan_tree.h"
#include "planner/contingent/world_sets/world_progression.h"

namespace assay::contingent {

// The cases that a branch of a tree tells apart.
class BranchCases {
 public:
  // Keeps references. The node must be of the kind kWhether or kValue.
  BranchCases(const GroundTask& task, const PlanNode& node);

  // Divides the worlds so that each of them has one answer to the branch's question.
  void Split(WorldProgression& progression, Worlds& worlds) const;
  // Returns the child for this world, or -1 if there is none.
  int ChildFor(const WorldProgression& progression, const World& world) const;
  // Returns what the branch asks: a function or a formula.
  std::string Question() const;

 private:
  const GroundTask& task_;
  const PlanNode& node_;
  // The literals on which the branch depends: one list for each child if it asks a function, and
  // one list if it asks a formula.
  std::vector<std::vector<GroundLiteral>> cases_;
};

}  // namespace assay::contingent
