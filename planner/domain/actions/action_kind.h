#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/domain/workcell/uncertainty_operations.h"

namespace assay::domain {

struct ActionTemplate;
struct Condition;
class PlanVariables;
struct Problem;

// The arguments that an action can have, as files and texts state them.
enum class Argument {
  kPart,      // the part that the action handles
  kMating,    // the mating that the action makes; the action handles the mating's held part
  kGrasp,     // the grasp with which the hand holds the part
  kPosition,  // the place of the part; in a mating, the place of the fixed part
  kSensor,
};

// The requirements that an action can have. The independent checker (plan/check/world_state.h)
// tests them.
enum class Need {
  kOpenHand,  // the hand is open and holds nothing
  kHolding,   // the hand holds the part with the action's grasp
  kAtPlace,   // the part, or the fixed part of the mating, is at the action's place
  kAlone,     // the part is mated with no other part
  kFree,      // the part is mated into no other part, although another part may be in it
  kSensor,    // the problem allows the sensor
};

// The place where an action leaves the part that it handles.
enum class Leaves {
  kWhereItWas,
  kInHand,
  kAtPlace,  // at the action's place
  kMated,    // in the fixed part of the mating
};

// The description of one kind of action. The libraries above derive everything they do with an
// action from this description, so a new kind of action needs no change in those libraries. The
// robot of a problem can do the kinds in Problem::actions.
struct ActionKind {
  std::string_view name;  // the name in files and texts
  std::string_view summary = {};
  std::vector<Argument> arguments = {};        // all arguments, in the order of files
  std::vector<Argument> short_arguments = {};  // the arguments that identify an action in a plan
  std::vector<Need> needs = {};
  Leaves leaves = Leaves::kWhereItWas;
  // The quantity that a verification after the action measures; none if it is not verified.
  std::optional<MeasuredQuantity> measured = {};
  // Returns every action of this kind that adds the condition, with fresh variables (Spar, figure
  // 3). If null, the planner adds such actions only to reduce uncertainty.
  std::vector<ActionTemplate> (*achieve)(const Problem& problem, const Condition& condition,
                                         PlanVariables& variables) = nullptr;

  bool Has(Argument argument) const;
  bool Needs(Need need) const;
  // Returns true if the pads close on a part that the hand does not hold yet.
  bool ClosesPads() const { return Has(Argument::kGrasp) && !Needs(Need::kHolding); }
};

// Returns a text such as "pickup(block, BG3)". `text_of` returns the text of one argument.
std::string Text(const ActionKind& kind, std::span<const Argument> arguments,
                 const std::function<std::string(Argument)>& text_of);

}  // namespace assay::domain
