#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/cli/tree_output/contingent_report.h"
#include "sim/execution/hidden_worlds/leaves.h"
#include "sim/execution/interpretation/knowledge_scenario.h"

namespace assay::cli {

// Returns the plan tree of a scenario. The tree of an assembly is made already. Other trees are
// planned within a budget of knowledge states.
ContingentAnswer TreeOf(const execution::Interpretation& interpretation,
                        std::int64_t budget = kKnowledgeStates);

// The hidden worlds of the trials of a plan tree. They depend only on the seed.
class TreeWorlds {
 public:
  // If `is_every_leaf`, the trials go through the leaves in turn, and otherwise hidden values are
  // drawn at random. Keeps references to scenario and tree. Throws UsageError if the tree has too
  // many leaves, or if no world leads to a leaf.
  TreeWorlds(const execution::KnowledgeScenario& scenario, const contingent::PlanTree& tree,
             std::uint64_t seed, bool is_every_leaf);

  const std::vector<execution::Leaf>& leaves() const { return leaves_; }
  // Returns, for each leaf, the reason why no world leads to it. A reason is empty if a world leads
  // there, or if worlds are drawn at random. Verbs report these reasons.
  const std::vector<std::string>& unreachable() const { return unreachable_; }
  // Returns the number of leaves that a world leads to; 0 if worlds are drawn.
  std::size_t reachable_count() const { return reachable_.size(); }

  // Returns the world for the trial of a verb with this number, from 1.
  execution::HiddenWorld WorldOf(int number) const;

 private:
  void FindReachable();

  const execution::KnowledgeScenario& scenario_;
  const std::uint64_t seed_;
  std::vector<execution::Leaf> leaves_;
  std::vector<std::string> unreachable_;
  std::vector<std::size_t> reachable_;  // indices of leaves
};

}  // namespace assay::cli
