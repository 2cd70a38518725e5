#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/algebra/bounding_methods/first_order.h"
#include "planner/algebra/sup_inf/constraint_set.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/certificates/certificate.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/error_sets/uncertain_pose.h"

namespace assay::uncertainty {

using domain::PartId;

// The declared error that bounds a variable: of a part at the start, of the hand at a commanded
// pose, or of a sensor. All other variables are derived by this library.
struct ErrorSource {
  enum class Of { kDerived, kPart, kHand, kSensor };
  Of of = Of::kDerived;
  std::size_t sensor = 0;  // index in the workcell's sensors

  bool operator==(const ErrorSource&) const = default;
};

// A variable that is an error as it was declared.
struct DeclaredError {
  std::string name;  // "peg.x", "hand.theta", "overhead-camera.z"
  int draw = 1;      // errors of the hand and of a sensor are drawn anew each time
};

// The knowledge about all poses at one time of a plan instance: the world description of Spar's
// uncertainty-reduction level. Copies share their variables, and expressions must not outlive the
// last copy. Two copies that go on in different ways stay independent of each other. Equal
// declarations in both give the same variable, so no expression may combine what the two know.
class UncertainWorld {
 public:
  // Creates the world as the problem begins.
  UncertainWorld(const domain::Problem& problem, Propagation propagation);

  const domain::Problem& problem() const { return *problem_; }
  Propagation propagation() const { return propagation_; }

  // Returns the part's planned pose. For the part in the hand, it is the pose at which it was
  // taken.
  const Pose& X_WorldPart(PartId part) const { return parts_[part.index()].X_WorldPart; }
  // Returns the difference between the part's believed pose and its planned pose.
  const BelievedShift& shift(PartId part) const { return parts_[part.index()].shift; }
  // Returns the part's error about its believed pose, in axes that turn with that pose. The hand's
  // work on the part is shifted and turned like the believed pose. So everything between the two
  // happens as if the believed pose had never changed.
  const RestingError& resting(PartId part) const { return parts_[part.index()].error; }
  // Returns the part's error about its believed pose, in the world's axes. This is what a sensor
  // measures.
  const RestingError& resting_in_world(PartId part) const { return parts_[part.index()].in_world; }
  // Returns the part's error about its planned pose, in the world's axes.
  RestingError about_plan(PartId part) const;
  // Returns how far a point that moves with the part's believed pose is shifted from its planned
  // place.
  BelievedShift ShiftAt(PartId part, const Vector3& point) const;
  PartId in_hand() const { return in_hand_; }  // None: the hand is empty
  const HeldError& held() const { return held_; }

  // Returns the error of the hand at one more commanded pose: new variables each time (sound mode),
  // or always the same variables (paper mode).
  ManipulatorError DrawManipulator();
  // Returns the error of the table's height where a part is put down: the problem's error of the
  // part's z.
  Expression DrawTableHeight(PartId part);
  // Returns a bounded variable that is new to this world and belongs to a part, or to the hand if
  // the part is None. Returns a number if the interval has no width.
  Expression Declare(const plan::ErrorKind& kind, const Interval& range, PartId part,
                     const ErrorSource& source = {});

  // Sets the error of the part in the hand. In sound mode, this function and SetResting condense
  // what they set: a long expression is replaced by an affine form (affine_form.h), whose
  // rest is a new variable. Otherwise expressions would grow by a factor with every action (Spar,
  // "Propagation of Uncertainty").
  void SetHeld(PartId part, const HeldError& error);
  // Sets a part down: at the plan's X_WorldPart, with its believed pose shifted from there by
  // `shift`. `error` is in the axes of `resting`.
  void SetResting(PartId part, const Pose& X_WorldPart, const RestingError& error,
                  const BelievedShift& shift);
  // Changes the believed pose of a part that stays where it is. `in_world` is in the axes of
  // `resting_in_world`.
  void SetBelieved(PartId part, const BelievedShift& shift, const RestingError& in_world);
  // Records that every part that rests is observed to be where the plan has it. Heights keep their
  // errors unless `with_heights` is set.
  void TellWherePartsRest(bool with_heights);

  const algebra::ConstraintSet& constraints() const {  // box of all variables
    return variables_->declared;
  }
  // Return guaranteed ranges, which contain all values of the expression. RangeOf uses plain
  // interval arithmetic, and TightRangeOf the tighter bounding methods.
  Interval RangeOf(const Expression& expression) const;
  Interval TightRangeOf(const Expression& expression) const;
  // The next four functions return bounds to first order. These functions need very little work if
  // many parts of the expression have been bounded before.
  algebra::Glance GlanceAbove(const Expression& expression, double limit) const;
  algebra::Glance GlanceBelow(const Expression& expression, double limit) const;
  algebra::Bound FirstOrderAbove(const Expression& expression) const;
  algebra::Bound FirstOrderBelow(const Expression& expression) const;
  // Returns the parts whose errors occur in the expressions, in increasing order.
  std::vector<PartId> PartsIn(const std::vector<Expression>& expressions) const;
  // Returns the variables that occur in the expressions, with name and range.
  std::vector<plan::ErrorVariable> VariablesIn(const std::vector<Expression>& expressions) const;
  const std::string& NameOf(algebra::VariableId variable) const;
  // Returns the declared error that the variable is. None: the variable is derived.
  std::optional<DeclaredError> DeclaredAs(algebra::VariableId variable) const;
  // Returns the expression to first order over the box of all variables.
  algebra::FirstOrderForm ToFirstOrder(const Expression& expression) const;

 private:
  struct PartKnowledge {
    Pose X_WorldPart;
    BelievedShift shift;
    RestingError error;
    RestingError in_world;
  };
  struct Variables {
    algebra::ExpressionPool pool;
    algebra::ConstraintSet declared = {};
    std::vector<const plan::ErrorKind*> kinds = {};  // by VariableId
    std::vector<PartId> owners = {};  // the part of each variable, by VariableId; None: the hand
    std::vector<ErrorSource> sources = {};  // by VariableId
    std::vector<int> numbers = {};  // among the variables of the same kind and owner, by VariableId
    algebra::FirstOrderForms first_order = {};
    std::map<int, Interval> tight_ranges = {};  // by Expression::index
  };

  // Returns the part's name, or "hand", in the form that ends the names of variables.
  std::string SymbolName(PartId part) const;
  // Returns the expression as a linear form plus a new variable for the rest, if the expression is
  // large.
  Expression Condensed(const Expression& e, const plan::ErrorKind& rest, PartId part);
  RestingError Condensed(const RestingError& error, PartId part);

  const domain::Problem* problem_;
  Propagation propagation_;
  std::shared_ptr<Variables> variables_;
  // The number of variables whose name begins with this text, which names the kind of error and its
  // owner.
  std::map<std::string, int> count_by_stem_;
  std::vector<PartKnowledge> parts_;
  PartId in_hand_ = PartId::None();
  HeldError held_;
  std::shared_ptr<const ManipulatorError> only_draw_;  // only set in paper mode
};

// Returns the greatest absolute value of an error in the interval.
double Magnitude(const Interval& range);
// Returns the greatest absolute value that the expression may have.
double MostOf(const UncertainWorld& world, const Expression& expression);
// Returns the greatest distance, in metres, by which an error displaces any point of a part in the
// plane of the table.
double ReachOf(const UncertainWorld& world, PartId part, const RestingError& error);

}  // namespace assay::uncertainty
