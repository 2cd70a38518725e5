#include "planner/uncertainty/uncertain_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "planner/algebra/bounds.h"
#include "planner/algebra/interval_arithmetic.h"

namespace assay::uncertainty {

// "peg-1" becomes "peg_1": names of variables have no hyphens.
std::string UncertainWorld::SymbolName(PartId part) const {
  std::string name = problem_->part(part).name;
  std::ranges::replace(name, '-', '_');
  return name;
}

UncertainWorld::UncertainWorld(const domain::Problem& problem, Propagation propagation)
    : problem_(&problem), propagation_(propagation), variables_(std::make_shared<Variables>()) {
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const domain::Part& part = problem.parts[p];
    const PartId id(p);
    const RestingError error = {.displacement = {DeclareOfPart("dx", part.error.x, id),
                                                 DeclareOfPart("dy", part.error.y, id),
                                                 DeclareOfPart("dz", part.error.z, id)},
                                .theta = DeclareOfPart("theta", part.error.theta, id)};
    parts_.push_back({part.X_WorldPart, error, error});
  }
}

Expression UncertainWorld::Declare(const std::string& stem, const Interval& range, PartId part) {
  if (range.low == range.high) return range.low;
  const int count = ++variables_->declared[stem];
  std::string name = count == 1 ? stem : fmt::format("{}_{}", stem, count);
  // A part may be called what another part's second variable would be.
  while (variables_->pool.Find(name)) name += '_';
  variables_->owners.push_back(part);
  return variables_->pool.Declare(std::move(name), range);
}

Expression UncertainWorld::DeclareOfPart(const char* what, const Interval& range, PartId part) {
  return Declare(fmt::format("{}_{}", what, SymbolName(part)), range, part);
}

ManipulatorError UncertainWorld::DrawManipulator() {
  if (only_draw_) return *only_draw_;
  const domain::PoseError& error = problem_->gripper_error;
  const ManipulatorError draw = {.x = Declare("dx_hand", error.x, PartId::None()),
                                 .y = Declare("dy_hand", error.y, PartId::None()),
                                 .z = Declare("dz_hand", error.z, PartId::None()),
                                 .theta = Declare("theta_hand", error.theta, PartId::None())};
  if (propagation_ == Propagation::kPaper) {
    only_draw_ = std::make_shared<const ManipulatorError>(draw);
  }
  return draw;
}

Expression UncertainWorld::DrawTableHeight(PartId part) {
  return DeclareOfPart("dz", problem_->part(part).error.z, part);
}

void UncertainWorld::SetHeld(PartId part, const HeldError& error) {
  in_hand_ = part;
  held_ = error;
}

void UncertainWorld::SetResting(PartId part, const Pose& X_WorldPart, const RestingError& error) {
  if (in_hand_ == part) in_hand_ = PartId::None();
  parts_[part.index()] = {X_WorldPart, error, error};
}

void UncertainWorld::SetBelief(PartId part, const RestingError& error) {
  parts_[part.index()].error = error;
}

// What is believed differs from the plan by no more than the two errors together; so does where the
// part is then.
void UncertainWorld::Nudge(PartId part, const RestingError& error) {
  if (in_hand_ == part) in_hand_ = PartId::None();
  PartKnowledge& knowledge = parts_[part.index()];
  const auto moved = [&](const char* what, const Expression& about_plan, const Expression& before,
                         const Expression& after) {
    using algebra::operator+;
    using algebra::operator-;
    if (about_plan == before) return after;
    return DeclareOfPart(what, RangeOf(about_plan) - RangeOf(before) + RangeOf(after), part);
  };
  RestingError about_plan;
  constexpr std::array<const char*, 3> kNames = {"plan_x", "plan_y", "plan_z"};
  for (const int axis : {0, 1, 2}) {
    about_plan.displacement[axis] =
        moved(kNames[axis], knowledge.about_plan.displacement[axis],
              knowledge.error.displacement[axis], error.displacement[axis]);
  }
  about_plan.theta =
      moved("plan_theta", knowledge.about_plan.theta, knowledge.error.theta, error.theta);
  knowledge.error = error;
  knowledge.about_plan = about_plan;
}

algebra::ConstraintSet UncertainWorld::constraints() const {
  return algebra::DeclaredBox(variables_->pool);
}

Interval UncertainWorld::RangeOf(const Expression& expression) const {
  const algebra::ConstraintSet declared = constraints();
  return algebra::Evaluate(expression, std::span<const Interval>(declared.box));
}

Interval UncertainWorld::TightRangeOf(const Expression& expression) const {
  if (expression.IsConstant()) return {expression.constant(), expression.constant()};
  const algebra::BoundRequest request = {.highest = algebra::Rung::kCentred};
  const algebra::ConstraintSet box = constraints();
  return {algebra::BoundBelow(expression, box, request).value,
          algebra::BoundAbove(expression, box, request).value};
}

std::vector<PartId> UncertainWorld::PartsIn(const Expression& expression) const {
  std::set<PartId> parts;
  for (const algebra::VariableId v : algebra::VariablesOf(expression)) {
    const PartId owner = variables_->owners[v.index()];
    if (!owner.IsNone()) parts.insert(owner);
  }
  return {parts.begin(), parts.end()};
}

std::vector<plan::ErrorVariable> UncertainWorld::VariablesIn(
    const std::vector<Expression>& expressions) const {
  std::set<algebra::VariableId> occurring;
  for (const Expression& expression : expressions) {
    const std::vector<algebra::VariableId> own = algebra::VariablesOf(expression);
    occurring.insert(own.begin(), own.end());
  }
  std::vector<plan::ErrorVariable> variables;
  for (const algebra::VariableId v : occurring) {
    variables.push_back({variables_->pool.name(v), variables_->pool.bounds(v)});
  }
  return variables;
}

const std::string& UncertainWorld::NameOf(algebra::VariableId variable) const {
  return variables_->pool.name(variable);
}

double Magnitude(const Interval& range) {
  return std::max(std::abs(range.low), std::abs(range.high));
}

}  // namespace assay::uncertainty
