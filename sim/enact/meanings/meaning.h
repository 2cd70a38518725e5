#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"
#include "sim/enact/meanings/readings.h"
#include "sim/enact/meanings/roles.h"
#include "sim/enact/walk/hidden_world.h"
#include "sim/mujoco/data.h"
#include "sim/scene/scene.h"

namespace assay::enact {

// The simulator's present truth, which only audits and pictures may see.
struct Truth {
  const domain::Problem& problem;
  const scene::Scene& scene;
  const mujoco::Data& data;

  // The same, as this robot has it; None: as it is.
  scene::Scene SceneOf(RobotId robot) const;
  // Whether the part stands within the place.
  bool StandsAt(PartId part, const domain::Place& place) const;
};

// What a predicate of the domain means in the workcell.
class Meaning {
 public:
  virtual ~Meaning() = default;

  // What it lacks to mean something of these arguments; empty: nothing.
  virtual std::string Lacks(const Roles&) const { return {}; }
  virtual bool IsTrue(const Truth& truth, const Roles& roles) const = 0;
  // Whether it is about what is so. Otherwise it is about what was told: audits do not ask it.
  virtual bool IsAudited() const { return true; }
  // Whether there are sensors that tell it.
  virtual bool IsTold() const { return false; }
  // By what sensors have told; none: that is too little, or the sensor's error leaves it open.
  virtual std::optional<bool> Told(const Readings&, const Roles&) const { return std::nullopt; }
  // Of the scenario's world and the fault, before it is run; none: it depends on other things.
  virtual std::optional<bool> IsTrueIn(const HiddenWorld&, const Roles&) const {
    return std::nullopt;
  }
  // Keeps of what the part may be that of which it is true, or false, as wanted; all of it, if that
  // does not matter.
  virtual void Narrow(HiddenKinds&, bool /*wanted*/) const {}
};

struct MeaningContext {
  const domain::Problem& problem;
  const std::vector<sense::NamedColor>& colors;
};

// One word of `predicates: {PREDICATE: {is: WORD, ...}}`, a file each.
struct MeaningWord {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<const Meaning> (*read)(const Value& map, const MeaningContext& context);
};
extern const MeaningWord kInternal;   // {is: internal}
extern const MeaningWord kHeld;       // {is: held}
extern const MeaningWord kHandEmpty;  // {is: hand-empty}
extern const MeaningWord kOver;       // {is: over, place: TABLE}
extern const MeaningWord kHeavier;    // {is: heavier, than: kg}
extern const MeaningWord kColored;    // {is: colored, color: NAME}
extern const MeaningWord kAt;         // {is: at}
extern const MeaningWord kOccupied;   // {is: occupied}

// All of them.
std::span<const MeaningWord* const> MeaningWords();

// Null for {is: internal}: nothing in the workcell, so that no audit asks it. Throws InputError.
std::unique_ptr<const Meaning> ReadMeaning(const Value& map, const MeaningContext& context);

}  // namespace assay::enact
