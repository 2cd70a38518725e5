#include "planner/algebra/multiaffine/multiaffine_question.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

// Whatever is lost by underflow is below this.
constexpr double kVanishing = 1e-280;

double Size(const Sector& x) { return std::max(std::abs(x.low), std::abs(x.high)); }

}  // namespace

MultiaffineQuestion::MultiaffineQuestion(MultiaffineForm the_form)
    : form(std::move(the_form)),
      over_box(form),
      point(form),
      ascent(point),
      slope_error(form.variables.size()) {}

// Since sines and cosines of angles count as 1, a bound of the value's error also bounds the error
// of a derivative with respect to an angle.
void MultiaffineQuestion::BoundErrors(std::span<const Sector> box) {
  MultiaffineDerivatives<double>& magnitudes = point.derivatives();
  for (std::size_t i = 0; i < box.size(); ++i) {
    const int variable = static_cast<int>(i);
    if (!IsAngle(variable)) {
      magnitudes.SetDisplacement(variable, Size(box[i]));
    }
  }
  point_error = magnitudes.Value(form.point_error) + kVanishing;
  error = magnitudes.Value(form.error) + kVanishing;
  angle_reach = std::numbers::pi;
  for (int angle = 0; angle < form.angle_count; ++angle) {
    angle_reach += Size(box[angle]);
  }
  magnitudes.Differentiate(form.error);
  for (std::size_t i = 0; i < box.size(); ++i) {
    const int variable = static_cast<int>(i);
    slope_error[i] = IsAngle(variable) ? error : magnitudes.Slope(variable) + kVanishing;
  }
}

void MultiaffineQuestion::Begin(int sign_of_form) {
  sign = sign_of_form;
  attained = -kInfinity;
  evaluations = 1;
  best_point.clear();
}

NestedForm::AtomSet MultiaffineQuestion::AtomsOf(const std::vector<int>& variables) const {
  NestedForm::AtomSet atoms = 0;
  for (const int variable : variables) {
    const int atom = form.AtomOf(variable);
    atoms |= NestedForm::SetOf(atom);
    if (IsAngle(variable)) atoms |= NestedForm::SetOf(atom + 1);
  }
  return atoms;
}

void MultiaffineQuestion::PutInSettled() {
  reduction.Reduce(form.nested, sign, AtomsOf(free), point.derivatives().atoms(), reduced);
}

void MultiaffineQuestion::Climb(std::span<const int> variables, std::span<const Sector> sectors) {
  evaluations += ascent.Climb(reduced, variables, sectors);
  Offer();
}

double MultiaffineQuestion::Value() {
  ++evaluations;
  return point.derivatives().Value(reduced);
}

double MultiaffineQuestion::Offer() {
  ++evaluations;
  const double value = sign * point.derivatives().Value(form.nested);
  const double at_least = RoundedDown(value - point_error);
  if (at_least > attained) {
    attained = at_least;
    best_point = point.coordinates();
  }
  return value;
}

}  // namespace assay::algebra
