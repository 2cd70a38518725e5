#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "planner/contingent/grounding/ground_task.h"
#include "sim/execution/hidden_worlds/hidden_world.h"
#include "sim/execution/predicates/predicate.h"
#include "sim/execution/predicates/quantity.h"
#include "sim/execution/skills/skill.h"
#include "sim/scenario/scenario.h"

namespace assay::execution {

// The condition for spilling: a part of which `predicate` is true spills if it is tilted by more
// than `beyond` from its orientation at the start.
struct Spill {
  std::string predicate;
  double beyond = 0;  // radians
};

struct PlannedWorlds;

// A contingent planning problem together with the meaning of its words in a workcell: the skill of
// each action, and the meaning of each predicate and function. The problem's symbols are the names
// of parts and tables.
struct Interpretation {
  contingent::GroundTask task;
  std::map<std::string, std::unique_ptr<const Skill>> skills;
  std::map<std::string, std::unique_ptr<const Predicate>> predicates;
  // The quantities by the names of their numeric functions. A function that is internal to the
  // domain has a null pointer.
  std::map<std::string, std::unique_ptr<const Quantity>> quantities;
  std::vector<sense::NamedColor> colors;  // colours that the camera can distinguish
  HiddenParts hidden;
  // The parts that the extern `reachable` found to be served by no grasp, and why: "bottle
  // (tableRight, left): none of its 12 grasps works; conditions that are not met: the tool leans at
  // most 60 deg from straight down for 12".
  std::vector<std::string> unserved;
  std::optional<Spill> spill;
  // The worlds of an assembly plan (plan_interpretation.h); null for other problems.
  std::shared_ptr<const PlannedWorlds> planned = nullptr;

  int WorldCount() const;
  // Returns the atom's predicate in the workcell; null if it is internal to the domain.
  const Predicate* PredicateOf(contingent::AtomId atom) const;
  // Returns whether a sensor can observe the truth of the atom.
  bool IsObservable(contingent::AtomId atom) const {
    const Predicate* const predicate = PredicateOf(atom);
    return predicate != nullptr && predicate->IsObservable();
  }
  // Returns the quantity of a numeric function; null if it is internal to the domain.
  const Quantity* QuantityOf(contingent::FunctionId function) const;
  // Returns whether the predicate of `spill` is true of the part in the simulator.
  bool CanSpill(const Truth& truth, PartId part) const;
};

}  // namespace assay::execution
