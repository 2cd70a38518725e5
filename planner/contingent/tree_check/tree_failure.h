#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/world_sets/world_progression.h"

namespace assay::contingent {

// The steps on the path through a tree, and the first condition that fails on it.
class TreeFailure {
 public:
  // The object keeps references to its arguments. `were_drawn` is true if the worlds are a sample.
  TreeFailure(const GroundTask& task, const WorldProgression& progression, bool were_drawn,
              std::size_t most_worlds)
      : task_(task),
        progression_(progression),
        were_drawn_(were_drawn),
        most_worlds_(most_worlds) {}

  std::size_t depth() const { return steps_.size(); }
  void Step(std::string step) { steps_.push_back(std::move(step)); }
  void GoBack(std::size_t depth) { steps_.resize(depth); }

  // Records a failure at the end of the path, unless a failure was recorded before. The message
  // names the steps and the world, or the first world of the history if `world` is null.
  void Fail(const std::string& what, const History& history, const World* world = nullptr);
  // Records a failure if a function got two values at once, unless a failure was recorded before.
  void FailIfTwoValued(const History& history);

  bool HasHappened() const;
  std::string Text() const;  // empty if nothing has failed

 private:
  std::string TextOf(const World& world) const;

  const GroundTask& task_;
  const WorldProgression& progression_;
  bool were_drawn_;
  std::size_t most_worlds_;
  std::vector<std::string> steps_;
  std::string failure_;
};

}  // namespace assay::contingent
