#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "planner/contingent/grounding/ground_task.h"
#include "sim/enact/meanings/meaning.h"
#include "sim/enact/meanings/quantity.h"
#include "sim/enact/skills/skill.h"
#include "sim/enact/walk/hidden_world.h"
#include "sim/scenario/scenario.h"

namespace assay::enact {

// What spills: a part of which a predicate is true, when it is tilted further than this from how
// it stood.
struct Spill {
  std::string predicate;
  double beyond = 0;  // radians
};

struct PlannedWorlds;

// A problem of contingent planning, and what its words are in a workcell: which skill each action
// is, what each predicate means. Symbols are the names of parts and tables.
struct Interpretation {
  contingent::GroundTask task;
  std::map<std::string, std::unique_ptr<const Skill>> skills;         // by action
  std::map<std::string, std::unique_ptr<const Meaning>> meanings;     // by predicate or function;
                                                                      // null: internal
  std::map<std::string, std::unique_ptr<const Quantity>> quantities;  // by numeric function; the
                                                                      // same
  std::vector<sense::NamedColor> colors;                              // that can be told
  HiddenParts hidden;
  // What the extern `reachable` found that no grasp serves, and why: "bottle (tableRight, left):
  // not true of its 12 grasps: the tool leans at most 60 deg from straight down for 12".
  std::vector<std::string> unserved;
  std::optional<Spill> spill;
  // Of plans of assemblies (plan_interpretation.h); else null.
  std::shared_ptr<const PlannedWorlds> planned = nullptr;

  int WorldCount() const;  // of the scenario: 1 unless poses are open
  // Of an atom; null if it is internal.
  const Meaning* MeaningOf(contingent::AtomId atom) const;
  // Whether there are sensors that tell whether it is true.
  bool IsTold(contingent::AtomId atom) const {
    const Meaning* const meaning = MeaningOf(atom);
    return meaning != nullptr && meaning->IsTold();
  }
  // Of a numeric function; null if it is internal.
  const Quantity* QuantityOf(contingent::FunctionId function) const;
  // A part of which the predicate `spill` is true, in the simulator.
  bool CanSpill(const Truth& truth, PartId part) const;
};

}  // namespace assay::enact
