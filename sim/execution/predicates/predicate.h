#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "sim/execution/hidden_worlds/hidden_world.h"
#include "sim/execution/predicates/readings.h"
#include "sim/execution/predicates/roles.h"
#include "sim/mujoco/data.h"
#include "sim/scene/scene.h"

namespace assay::execution {

// The true state in the simulator at present. Only audits and pictures may see it.
struct Truth {
  const domain::Problem& problem;
  const scene::Scene& scene;
  const mujoco::Data& data;

  // Returns the scene in which this robot acts (Scene::WorkedBy); None returns the scene unchanged.
  scene::Scene SceneOf(RobotId robot) const;
  // Returns whether the part stands within the place: its origin is there, and it rests in the
  // stable pose of the start.
  bool StandsAt(PartId part, const domain::Place& place) const;
};

// A predicate of a domain, as it is true or false in the workcell.
class Predicate {
 public:
  virtual ~Predicate() = default;

  // Returns the kind of argument that the predicate needs and the atom lacks, like "part"; empty if
  // nothing is missing.
  virtual std::string Lacks(const Roles&) const { return {}; }
  virtual bool IsTrue(const Truth& truth, const Roles& roles) const = 0;
  // Returns whether audits compare the predicate with the truth. Audits leave out predicates about
  // past readings.
  virtual bool IsAudited() const { return true; }
  // Returns whether a sensor can observe the predicate.
  virtual bool IsObservable() const { return false; }
  // Returns the predicate's value according to the readings of the sensors. Returns none if the
  // readings are too few, or if a sensor's error leaves the value open.
  virtual std::optional<bool> Observed(const Readings&, const Roles&) const { return std::nullopt; }
  // Returns the predicate's value in the scenario's world with its fault, before the execution.
  // Returns none if the value depends on other things.
  virtual std::optional<bool> IsTrueIn(const HiddenWorld&, const Roles&) const {
    return std::nullopt;
  }
  // Removes those possible hidden properties of a part with which the predicate would not have the
  // value `wanted`. Removes nothing if the predicate does not depend on them.
  virtual void Narrow(HiddenKinds&, bool /*wanted*/) const {}
};

struct PredicateContext {
  const domain::Problem& problem;
  const std::vector<sense::NamedColor>& colors;
};

// A word that a scenario may give in `predicates: {PREDICATE: {is: WORD, ...}}`. Each word has its
// own source file.
struct PredicateWord {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<const Predicate> (*read)(const Value& map, const PredicateContext& context);
};
extern const PredicateWord kInternal;   // {is: internal}
extern const PredicateWord kHeld;       // {is: held}
extern const PredicateWord kHandEmpty;  // {is: hand-empty}
extern const PredicateWord kOver;       // {is: over, place: TABLE}
extern const PredicateWord kHeavier;    // {is: heavier, than: kg}
extern const PredicateWord kColored;    // {is: colored, color: NAME}
extern const PredicateWord kAt;         // {is: at}
extern const PredicateWord kOccupied;   // {is: occupied}

// Returns all skill words.
std::span<const PredicateWord* const> PredicateWords();

// Reads a map like {is: WORD, ...}. Returns null for {is: internal}, which stands for nothing in
// the workcell, so that no audit checks it. Throws InputError.
std::unique_ptr<const Predicate> ReadPredicate(const Value& map, const PredicateContext& context);

}  // namespace assay::execution
