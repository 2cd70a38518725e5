#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/base/random.h"
#include "planner/domain/problem/units.h"
#include "planner/domain/reach/reachability.h"
#include "sim/enact/meanings/readings.h"
#include "sim/enact/meanings/roles.h"
#include "sim/enact/walk/robots.h"
#include "sim/exec/execution/execution.h"
#include "sim/exec/execution/step_execution.h"

namespace assay::enact {

// What a skill works with: the execution of the robot that acts, which believes what commands and
// sensors tell it, the robots as a whole, and what sensors have told besides.
struct Situation {
  Robots& robots;
  Readings& readings;
  RandomStream& sensor_noise;
  sense::ColorSensor* color_sensor;                     // null if the scenario names no colours
  sense::PoseSensor* pose_sensor;                       // null if no pose is open
  std::unique_ptr<exec::StepExecution> step = nullptr;  // of a plan, on its way

  exec::Execution& execution() const { return robots.acting(); }
  const domain::Problem& problem() const { return execution().problem(); }
  // Where the parts other than `but` are believed to be; none of them is in the hand.
  std::vector<domain::PlacedPart> Standing(PartId but) const;
};

// What an action of the domain is in the workcell.
class Skill {
 public:
  virtual ~Skill() = default;

  // What it lacks to be done with these arguments; empty: nothing.
  virtual std::string Lacks(const Roles& roles) const { return roles.part.IsNone() ? "part" : ""; }
  // What a part in the hand may touch meanwhile.
  virtual exec::HeldTouches HeldMayTouch() const { return exec::HeldTouches::kNothing; }
  // Does it, by what is believed and felt alone.
  virtual exec::Progress Do(const Roles& roles, Situation& situation) const = 0;
};

struct SkillContext {
  const domain::Problem& problem;
  const domain::Units& units;  // of the scenario file
  const std::vector<sense::NamedColor>& colors;
};

// One word of `actions: {ACTION: {skill: WORD, ...}}`, a file each.
struct SkillWord {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<const Skill> (*read)(const Value& map, const SkillContext& context);
};
extern const SkillWord kPickUp;   // {skill: pick-up}
extern const SkillWord kWeigh;    // {skill: weigh, error: newtons}
extern const SkillWord kCarry;    // {skill: carry, to: TABLE, upright: angle}
extern const SkillWord kPutDown;  // {skill: put-down}
extern const SkillWord kLook;     // {skill: look}

// All of them.
std::span<const SkillWord* const> SkillWords();

// Throws InputError.
std::unique_ptr<const Skill> ReadSkill(const Value& map, const SkillContext& context);

// Turns about the vertical that are tried wherever a part may be put down.
inline constexpr int kYawsTried = 8;

// Runs commands one after the other.
exec::Progress RunAll(const std::vector<exec::Command>& commands, exec::Execution& execution);

}  // namespace assay::enact
