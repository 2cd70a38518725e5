#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::view {

// A line of a plan tree: an action, the outcome of a branch, or a note such as "go to 2".
struct TreeLine {
  int depth = 0;  // number of branches above it
  std::string text;
  bool is_action = false;
  bool is_gone = false;         // the execution went this way
  std::vector<int> steps = {};  // the actions of the way that belong to the line, from 0
};

// Where a part may be when an action ends, for all errors: poses at the extremes, world frame.
struct Region {
  domain::PartId part;
  std::vector<geometry::Pose> extremes;
};

// A fact about an action with its name: "contacts at its end", "vertex 3 on face 1".
struct Fact {
  std::string name;
  std::string value;
};

// An action of an execution that does not follow one plan.
struct WalkedAction {
  std::string action;
  plan::StepId step = plan::StepId::None();  // of the plan of the execution's world, if it is one
  std::optional<double> end = {};            // seconds; none if it was not reached
  std::vector<Fact> facts = {};
  std::optional<int> drawing = {};    // index in Way::drawings
  std::optional<Region> region = {};  // shown until the action ends
};

// The way that an execution went, if it did not follow one plan: through a plan tree, or through
// the motions of a strategy.
struct Way {
  std::vector<TreeLine> lines = {};  // empty if there is no tree
  std::vector<WalkedAction> actions = {};
  std::vector<std::string> drawings = {};  // SVG elements that are shown with actions
};

}  // namespace assay::view
