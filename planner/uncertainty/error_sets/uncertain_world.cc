#include "planner/uncertainty/error_sets/uncertain_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "planner/algebra/bounding_methods/affine_form.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/expression/simplify.h"
#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/algebra/normal_forms/normalization.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/collision.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::uncertainty {
namespace {

// Greatest number of operations in an expression that is kept as it is.
constexpr std::size_t kMostNodes = 60;
// share of an expression's variation below which variables go into the rest
constexpr double kNegligible = 0.02;

std::set<algebra::VariableId> VariablesOccurringIn(const std::vector<Expression>& expressions) {
  std::set<algebra::VariableId> occurring;
  for (const Expression& expression : expressions) {
    const std::vector<algebra::VariableId> own = algebra::VariablesOf(expression);
    occurring.insert(own.begin(), own.end());
  }
  return occurring;
}

// Returns the coordinate that an error of this kind is about, as scenarios name it.
std::string CoordinateOf(const plan::ErrorKind& kind) {
  return &kind == &plan::error::kX   ? "x"
         : &kind == &plan::error::kY ? "y"
         : &kind == &plan::error::kZ ? "z"
                                     : "theta";
}

}  // namespace

// Names of variables have no hyphens: "peg-1" becomes "peg_1".
std::string UncertainWorld::SymbolName(PartId part) const {
  if (part.IsNone()) return "hand";
  std::string name = problem_->part(part).name;
  std::ranges::replace(name, '-', '_');
  return name;
}

UncertainWorld::UncertainWorld(const domain::Problem& problem, Propagation propagation)
    : problem_(&problem), propagation_(propagation), variables_(std::make_shared<Variables>()) {
  algebra::KeepNormalForms(variables_->pool);
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const domain::Part& part = problem.parts[p];
    const PartId id(p);
    const ErrorSource at_start = {.of = ErrorSource::Of::kPart};
    const RestingError error = {
        .displacement = {Declare(plan::error::kX, part.error.x, id, at_start),
                         Declare(plan::error::kY, part.error.y, id, at_start),
                         Declare(plan::error::kZ, part.error.z, id, at_start)},
        .theta = Declare(plan::error::kTheta, part.error.theta, id, at_start)};
    parts_.push_back({part.X_WorldPart, {}, error, error});
  }
}

Expression UncertainWorld::Declare(const plan::ErrorKind& kind, const Interval& range, PartId part,
                                   const ErrorSource& source) {
  if (range.low == range.high) return range.low;
  auto& [pool, declared, kinds, owners, sources, numbers, first_order, tight_ranges] = *variables_;
  const std::string stem = fmt::format("{}_{}", kind.stem, SymbolName(part));
  int& count = count_by_stem_[stem];
  while (true) {
    const std::string name = ++count == 1 ? stem : fmt::format("{}_{}", stem, count);
    const std::optional<algebra::VariableId> known = pool.Find(name);
    if (!known) {
      kinds.push_back(&kind);
      owners.push_back(part);
      sources.push_back(source);
      numbers.push_back(count);
      declared.box.push_back(range);
      return pool.Declare(name, range);
    }
    const int v = known->index();
    const Interval& its = declared.box[v];
    if (kinds[v] == &kind && owners[v] == part && sources[v] == source && its.low == range.low &&
        its.high == range.high) {
      return pool.Variable(*known);
    }
  }
}

ManipulatorError UncertainWorld::DrawManipulator() {
  if (only_draw_) return *only_draw_;
  const domain::PoseError& error = problem_->gripper_error;
  const auto of_hand = [&](const plan::ErrorKind& kind, const Interval& range) {
    return Declare(kind, range, PartId::None(), {.of = ErrorSource::Of::kHand});
  };
  const ManipulatorError draw = {.x = of_hand(plan::error::kX, error.x),
                                 .y = of_hand(plan::error::kY, error.y),
                                 .z = of_hand(plan::error::kZ, error.z),
                                 .theta = of_hand(plan::error::kTheta, error.theta)};
  if (propagation_ == Propagation::kPaper) {
    only_draw_ = std::make_shared<const ManipulatorError>(draw);
  }
  return draw;
}

Expression UncertainWorld::DrawTableHeight(PartId part) {
  return Declare(plan::error::kZ, problem_->part(part).error.z, part);
}

Expression UncertainWorld::Condensed(const Expression& e, const plan::ErrorKind& rest,
                                     PartId part) {
  if (propagation_ == Propagation::kPaper || algebra::NodeCount(e) <= kMostNodes) return e;
  std::optional<algebra::AffineForm> form =
      variables_->first_order.Affine(e, constraints().box, kNegligible);
  if (!form) form = algebra::AffineFormOf(e, constraints().box, kNegligible);
  return form->linear + Declare(rest, form->rest, part);
}

RestingError UncertainWorld::Condensed(const RestingError& error, PartId part) {
  RestingError condensed = {.displacement = {},
                            .theta = Condensed(error.theta, plan::error::kThetaRest, part)};
  for (const int axis : {0, 1, 2}) {
    condensed.displacement[axis] = Condensed(error.displacement[axis], plan::error::kRest, part);
  }
  return condensed;
}

void UncertainWorld::SetHeld(PartId part, const HeldError& error) {
  in_hand_ = part;
  held_ = {.x = Condensed(error.x, plan::error::kRest, part),
           .z = Condensed(error.z, plan::error::kRest, part),
           .twist = Condensed(error.twist, plan::error::kThetaRest, part),
           .y = Condensed(error.y, plan::error::kRest, part),
           .skew = Condensed(error.skew, plan::error::kThetaRest, part),
           .tip = Condensed(error.tip, plan::error::kThetaRest, part),
           .is_round = error.is_round};
}

RestingError UncertainWorld::about_plan(PartId part) const {
  const PartKnowledge& knowledge = parts_[part.index()];
  return {algebra::Simplify(knowledge.shift.displacement + knowledge.in_world.displacement),
          knowledge.shift.turn + knowledge.in_world.theta};
}

BelievedShift UncertainWorld::ShiftAt(PartId part, const Vector3& point) const {
  const PartKnowledge& knowledge = parts_[part.index()];
  const SymbolicVector arm = AsVector(point - knowledge.X_WorldPart.translation());
  const SymbolicVector swung = algebra::RotationZ(knowledge.shift.turn) * arm - arm;
  return {algebra::Simplify(knowledge.shift.displacement + swung), knowledge.shift.turn};
}

void UncertainWorld::SetResting(PartId part, const Pose& X_WorldPart, const RestingError& error,
                                const BelievedShift& shift) {
  if (in_hand_ == part) in_hand_ = PartId::None();
  const RestingError condensed = Condensed(error, part);
  const SymbolicVector in_world =
      algebra::Simplify(algebra::RotationZ(shift.turn) * condensed.displacement);
  parts_[part.index()] = {X_WorldPart, shift, condensed,
                          Condensed({in_world, condensed.theta}, part)};
}

void UncertainWorld::SetBelieved(PartId part, const BelievedShift& shift,
                                 const RestingError& in_world) {
  PartKnowledge& knowledge = parts_[part.index()];
  knowledge.shift = shift;
  knowledge.in_world = in_world;
  knowledge.error = {algebra::Simplify(algebra::RotationZ(-shift.turn) * in_world.displacement),
                     in_world.theta};
}

void UncertainWorld::TellWherePartsRest(bool with_heights) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (PartId(p) == in_hand_) continue;
    const Expression height = with_heights ? 0 : parts_[p].in_world.displacement[2];
    SetBelieved(PartId(p), {}, {.displacement = {0, 0, height}, .theta = 0});
  }
}

Interval UncertainWorld::RangeOf(const Expression& expression) const {
  return algebra::Evaluate(expression, std::span<const Interval>(constraints().box));
}

Interval UncertainWorld::TightRangeOf(const Expression& expression) const {
  if (expression.IsConstant()) return {expression.constant(), expression.constant()};
  const auto [known, is_new] = variables_->tight_ranges.try_emplace(expression.index());
  if (is_new) {
    const algebra::BoundRequest request = {.highest = algebra::BoundingMethod::kCentred};
    const algebra::BothBounds bounds =
        algebra::PreparedExpression(expression).Both(constraints(), request);
    known->second = {bounds.inf.value, bounds.sup.value};
  }
  return known->second;
}

algebra::Glance UncertainWorld::GlanceAbove(const Expression& expression, double limit) const {
  return variables_->first_order.Above(expression, constraints().box, limit);
}
algebra::Glance UncertainWorld::GlanceBelow(const Expression& expression, double limit) const {
  return variables_->first_order.Below(expression, constraints().box, limit);
}

algebra::Bound UncertainWorld::FirstOrderAbove(const Expression& expression) const {
  return variables_->first_order.BoundAbove(expression, constraints().box);
}
algebra::Bound UncertainWorld::FirstOrderBelow(const Expression& expression) const {
  return variables_->first_order.BoundBelow(expression, constraints().box);
}

std::vector<PartId> UncertainWorld::PartsIn(const std::vector<Expression>& expressions) const {
  std::set<PartId> parts;
  for (const algebra::VariableId v : VariablesOccurringIn(expressions)) {
    const PartId owner = variables_->owners[v.index()];
    if (!owner.IsNone()) parts.insert(owner);
  }
  return {parts.begin(), parts.end()};
}

std::vector<plan::ErrorVariable> UncertainWorld::VariablesIn(
    const std::vector<Expression>& expressions) const {
  std::vector<plan::ErrorVariable> variables;
  for (const algebra::VariableId v : VariablesOccurringIn(expressions)) {
    variables.push_back({variables_->pool.name(v), variables_->pool.bounds(v),
                         variables_->kinds[v.index()]->dimension});
  }
  return variables;
}

const std::string& UncertainWorld::NameOf(algebra::VariableId variable) const {
  return variables_->pool.name(variable);
}

std::optional<DeclaredError> UncertainWorld::DeclaredAs(algebra::VariableId variable) const {
  const int v = variable.index();
  const ErrorSource& source = variables_->sources[v];
  if (source.of == ErrorSource::Of::kDerived) return std::nullopt;
  const domain::UncertaintyOperations& operations = problem_->workcell->uncertainty_operations();
  const std::string owner = source.of == ErrorSource::Of::kHand ? "hand"
                            : source.of == ErrorSource::Of::kPart
                                ? problem_->part(variables_->owners[v]).name
                                : operations.sensors[source.sensor].name;
  return DeclaredError{owner + "." + CoordinateOf(*variables_->kinds[v]), variables_->numbers[v]};
}

algebra::FirstOrderForm UncertainWorld::ToFirstOrder(const Expression& expression) const {
  if (expression.IsConstant()) return {.centre = expression.constant()};
  algebra::FirstOrderForms& forms = variables_->first_order;
  algebra::FirstOrderForm form = forms.Form(expression, constraints().box);
  if (std::isfinite(form.rest)) return form;
  const algebra::AffineForm affine = algebra::AffineFormOf(expression, constraints().box, 0);
  form = forms.Form(affine.linear, constraints().box);
  form.centre += (affine.rest.low + affine.rest.high) / 2;
  form.rest = algebra::AtLeast(form.rest + Width(affine.rest) / 2);
  return form;
}

double Magnitude(const Interval& range) {
  return std::max(std::abs(range.low), std::abs(range.high));
}

double MostOf(const UncertainWorld& world, const Expression& expression) {
  return Magnitude(world.RangeOf(expression));
}

double ReachOf(const UncertainWorld& world, PartId part, const RestingError& error) {
  return std::hypot(MostOf(world, error.displacement[0]), MostOf(world, error.displacement[1])) +
         world.problem().part(part).model->shape().radius() * MostOf(world, error.theta);
}

}  // namespace assay::uncertainty
