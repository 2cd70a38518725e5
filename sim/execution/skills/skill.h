#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/base/random.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/domain/units/units.h"
#include "sim/execution/predicates/readings.h"
#include "sim/execution/predicates/roles.h"
#include "sim/execution/robots/execution.h"
#include "sim/execution/robots/robots.h"
#include "sim/execution/walk/step_execution.h"

namespace assay::execution {

// The things that a skill works with: the robots, and the readings and sensors of the trial. The
// execution of the acting robot holds the believed poses, which follow from commands and sensors.
struct Situation {
  Robots& robots;
  Readings& readings;
  RandomStream& sensor_noise;
  sense::ColorSensor* color_sensor;               // null if the scenario names no colours
  sense::PoseSensor* pose_sensor;                 // null if no pose is open
  std::unique_ptr<StepExecution> step = nullptr;  // a plan's step in progress

  Execution& execution() const { return robots.acting(); }
  const domain::Problem& problem() const { return execution().problem(); }
};

// The meaning of a domain's action in the workcell: how a robot carries it out.
class Skill {
 public:
  virtual ~Skill() = default;

  // Returns the kind of argument that the skill needs and the action lacks, like "part"; empty if
  // nothing is missing.
  virtual std::string Lacks(const Roles& roles) const { return roles.part.IsNone() ? "part" : ""; }
  // Returns what a part in the hand may touch while the skill is carried out.
  virtual HeldTouches HeldMayTouch() const { return HeldTouches::kNothing; }
  // Carries out the skill. It may use only what is believed and felt, not the simulator's truth.
  virtual Progress Do(const Roles& roles, Situation& situation) const = 0;
};

struct SkillContext {
  const domain::Problem& problem;
  const domain::Units& units;  // the units of the scenario file
  const std::vector<sense::NamedColor>& colors;
};

// A word that a scenario may give in `actions: {ACTION: {skill: WORD, ...}}`. Each word has its own
// source file.
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

// Returns all skill words.
std::span<const SkillWord* const> SkillWords();

// Reads a map like {skill: WORD, ...}. Throws InputError.
std::unique_ptr<const Skill> ReadSkill(const Value& map, const SkillContext& context);

// Executes the commands one after the other until one fails.
Progress RunAll(const std::vector<Command>& commands, Execution& execution);

}  // namespace assay::execution
