#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::domain {

// A plan variable. It stands for a grasp or for a position of one part until a plan instance
// chooses one.
using VariableId = Id<struct PlanVariableTag>;

enum class VariableKind { kGrasp, kPosition };

struct PlanVariable {
  VariableKind kind;
  PartId part;
  std::string name;  // "grasp_1", "pos_2", "init_pos_1"
};

// The plan variables of one plan. Each gets a fresh name.
class PlanVariables {
 public:
  // Adds a variable that belongs to a step: "grasp_1", "pos_1".
  VariableId Add(VariableKind kind, PartId part);
  // Adds a variable that belongs to a precondition, and is to be bound to the establisher's
  // variable: "Grasp", "Position".
  VariableId AddFree(VariableKind kind, PartId part);
  VariableId AddInitialPosition(PartId part);

  const PlanVariable& operator[](VariableId id) const { return variables_[id.index()]; }
  int size() const { return static_cast<int>(variables_.size()); }

 private:
  VariableId Push(PlanVariable variable);

  std::vector<PlanVariable> variables_;
  int grasps_ = 0;
  int positions_ = 0;
  int initial_positions_ = 0;
};

// The labels of a position variable are the part's stable poses by their index, followed by one
// label for the pose that the part has at the start.
inline int InitialLabel(const Part& part) {
  return static_cast<int>(part.model->stable_poses().size());
}
inline int PositionLabelCount(const Part& part) { return InitialLabel(part) + 1; }
inline int GraspLabelCount(const Part& part) { return static_cast<int>(part.grasps->size()); }

enum class Predicate {
  kGripperOpen,   // gripper(open)
  kHolding,       // holding(part, grasp)
  kPartLocation,  // part_location(part, position)
  kAssembled,     // assembled(...), with a mating
};

// An operational condition. Its object is constant. Its grasp or position is a plan variable, which
// links operational with geometric planning (Spar, "Representation of Goals").
struct Condition {
  Predicate predicate;
  PartId part = PartId::None();              // only for kHolding and kPartLocation
  VariableId variable = VariableId::None();  // only for kHolding and kPartLocation
  MatingId mating = MatingId::None();        // only for kAssembled

  static Condition GripperOpen() { return {.predicate = Predicate::kGripperOpen}; }
  static Condition Holding(PartId part, VariableId grasp) {
    return {.predicate = Predicate::kHolding, .part = part, .variable = grasp};
  }
  static Condition Located(PartId part, VariableId position) {
    return {.predicate = Predicate::kPartLocation, .part = part, .variable = position};
  }
  static Condition Assembled(MatingId mating) {
    return {.predicate = Predicate::kAssembled, .mating = mating};
  }
};

// Returns whether two conditions of actions can be made equal by the choice of their variables
// alone.
bool Unify(const Condition& a, const Condition& b);

std::string Text(const Problem& problem, const PlanVariables& variables,
                 const Condition& condition);

}  // namespace assay::domain
