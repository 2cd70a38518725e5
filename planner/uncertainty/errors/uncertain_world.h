#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planner/algebra/linear/constraint_set.h"
#include "planner/algebra/methods/first_order.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/certificate.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/errors/uncertain_pose.h"

namespace assay::uncertainty {

using domain::PartId;

// What is known of where everything is, at one moment of a plan instance: the world description of
// Spar's uncertainty-reduction level. Copies share their variables, so a copy must not outlive the
// last of them. Two copies that go on in different ways stay independent of each other, but declare
// the same variables as long as they declare alike: no expression may join what the two know.
class UncertainWorld {
 public:
  // As the problem begins.
  UncertainWorld(const domain::Problem& problem, Propagation propagation);

  const domain::Problem& problem() const { return *problem_; }
  Propagation propagation() const { return propagation_; }

  // Where the plan has the part; of the part in the hand: where it was taken.
  const Pose& X_WorldPart(PartId part) const { return parts_[part.index()].X_WorldPart; }
  // How the pose that is believed now differs from the plan's.
  const BeliefShift& shift(PartId part) const { return parts_[part.index()].shift; }
  // About where the part is believed to be, as seen from where the plan has it: what the hand does
  // with the part is shifted and turned like the belief, so that all that happens between the two
  // happens as if the belief had never changed.
  const RestingError& resting(PartId part) const { return parts_[part.index()].error; }
  // The same in the world's axes: what a sensor tells.
  const RestingError& resting_in_world(PartId part) const { return parts_[part.index()].in_world; }
  // About where the plan has it, in the world's axes.
  RestingError about_plan(PartId part) const;
  // By how much a point that goes with the part's believed pose is shifted from the plan's.
  BeliefShift ShiftAt(PartId part, const Vector3& point) const;
  PartId in_hand() const { return in_hand_; }  // None: the hand is empty
  const HeldError& held() const { return held_; }

  // The error of the hand at one more commanded pose: drawn afresh (sound), or ever the same
  // variables (paper).
  ManipulatorError DrawManipulator();
  // The table's height error where a part is put down: what the problem says of the part's z.
  Expression DrawTableHeight(PartId part);
  // A bounded variable that is new to this world and belongs to a part; a number if the interval
  // has no width.
  Expression Declare(const std::string& stem, const Interval& range, PartId part);
  // The part's name, as the names of its variables end.
  std::string SymbolName(PartId part) const;

  // What is set is condensed in sound mode: a long expression is replaced by an affine form
  // (algebra/affine_form.h), its rest a new variable. Otherwise expressions would grow by a factor
  // with every action (Spar, "Propagation of Uncertainty").
  void SetHeld(PartId part, const HeldError& error);
  // At X_WorldPart of the plan, the belief shifted from there; the error as `resting` tells it.
  void SetResting(PartId part, const Pose& X_WorldPart, const RestingError& error,
                  const BeliefShift& shift);
  // The part stays; what is believed of it changes. The error as `resting_in_world` tells it.
  void SetBelief(PartId part, const BeliefShift& shift, const RestingError& in_world);
  // Every part that rests turns out to be where the plan has it, its height as it may be unless
  // heights are told, too.
  void TellWherePartsRest(bool with_heights);

  const algebra::ConstraintSet& constraints() const {  // the box of all variables
    return variables_->declared;
  }
  // Guaranteed ranges of the expression, in which nothing is missing: by plain interval arithmetic,
  // and by the ladder of bounds.
  Interval RangeOf(const Expression& expression) const;
  Interval TightRangeOf(const Expression& expression) const;
  // To first order, for very little work where much has been asked before.
  algebra::Glance GlanceAbove(const Expression& expression, double limit) const;
  algebra::Glance GlanceBelow(const Expression& expression, double limit) const;
  algebra::Bound FirstOrderAbove(const Expression& expression) const;
  algebra::Bound FirstOrderBelow(const Expression& expression) const;
  // The parts whose errors occur in the expressions, in increasing order.
  std::vector<PartId> PartsIn(const std::vector<Expression>& expressions) const;
  // The variables that occur in the expressions, by name and range.
  std::vector<plan::ErrorVariable> VariablesIn(const std::vector<Expression>& expressions) const;
  const std::string& NameOf(algebra::VariableId variable) const;

 private:
  struct PartKnowledge {
    Pose X_WorldPart;
    BeliefShift shift;
    RestingError error;
    RestingError in_world;
  };
  struct Variables {
    algebra::ExpressionPool pool;
    algebra::ConstraintSet declared = {};
    std::vector<std::string> stems = {};  // by VariableId
    std::vector<PartId> owners = {};      // by VariableId; None: the hand
    algebra::FirstOrderForms first_order = {};
    std::map<int, Interval> tight_ranges = {};  // by Expression::index
  };

  // `rest`: the new variable's name before the part's.
  Expression Condensed(const Expression& e, const char* rest, PartId part);
  RestingError Condensed(const RestingError& error, PartId part);
  Expression DeclareOfPart(const char* what, const Interval& range, PartId part);

  const domain::Problem* problem_;
  Propagation propagation_;
  std::shared_ptr<Variables> variables_;
  std::map<std::string, int> count_by_stem_;  // of the variables of this world
  std::vector<PartKnowledge> parts_;
  PartId in_hand_ = PartId::None();
  HeldError held_;
  std::shared_ptr<const ManipulatorError> only_draw_;  // in paper mode
};

// The greatest absolute value in the interval.
double Magnitude(const Interval& range);

}  // namespace assay::uncertainty
