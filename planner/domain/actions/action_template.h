#pragma once

#include <string>
#include <vector>

#include "planner/domain/actions/action_kind.h"
#include "planner/domain/actions/condition.h"

namespace assay::domain {

// The constraints of geometric planning (Spar, Table 1).
enum class ConstraintKind {
  kMember,           // member(variable, labels)
  kInPositionClass,  // in_position_class(position, labels)
  kReachable,        // reachable(grasp, position)
  kMateReachable,    // mate_reachable(grasp, position, Ta)
};

struct GeometricConstraint {
  ConstraintKind kind;
  VariableId grasp = VariableId::None();  // only for kMember and the reachable constraints
  VariableId position = VariableId::None();
  MatingId mating = MatingId::None();  // only for kMateReachable: Ta
  std::vector<int> labels = {};        // only for kMember and kInPositionClass

  // Returns the variable that a unary constraint restricts.
  VariableId subject() const { return grasp.IsNone() ? position : grasp; }
};

// A geometric goal: the operational preconditions are to be established so that the constraint
// holds.
struct GeometricGoal {
  GeometricConstraint constraint;
  std::vector<int> qualifies;  // indices of operational preconditions of the same action
};

// A new plan variable and the labels that it may have. This initial constraint needs no check,
// because nothing refers to the variable yet.
struct InitialConstraint {
  VariableId variable;
  std::vector<int> labels;
};

// An action with its preconditions, add list and delete list (Spar, figure 2). Uncertainty
// preconditions are not part of it: procedures build them for plan instances.
struct ActionTemplate {
  const ActionKind* kind;
  PartId part = PartId::None();        // the part that the action handles
  MatingId mating = MatingId::None();  // only for an action that mates
  VariableId grasp = VariableId::None();
  VariableId position = VariableId::None();  // position of the part; in a mating, of the fixed part
  std::vector<Condition> preconditions = {};
  std::vector<GeometricGoal> geometric = {};
  std::vector<Condition> adds = {};
  std::vector<Condition> deletes = {};
  std::vector<InitialConstraint> initial = {};
};

// Returns the name of a label: "BG3", "BP2" or "initial".
std::string LabelName(const Problem& problem, const PlanVariable& variable, int label);
std::string Text(const Problem& problem, const PlanVariables& variables,
                 const GeometricConstraint& constraint);
std::string Text(const Problem& problem, const PlanVariables& variables,
                 const ActionTemplate& action);

}  // namespace assay::domain
