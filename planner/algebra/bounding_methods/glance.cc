#include "planner/algebra/bounding_methods/glance.h"

#include <algorithm>

#include "planner/algebra/bounding_methods/centred.h"
#include "planner/algebra/bounding_methods/monotone.h"
#include "planner/algebra/bounds/ascent.h"
#include "planner/algebra/compiled_forms/compiler.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

// Returns the maximization of the expression (sign = 1) or of its negation (sign = -1). The form
// has a single term, whose only atom is the expression.
Maximization AsItStands(const Expression& e, double sign, std::span<const Interval> box) {
  Maximization problem;
  problem.form = {{{.coefficient = {sign, sign}, .factors = {{.atom = e, .exponent = 1}}}}};
  problem.variables = VariablesOf(e);
  for (const VariableId variable : problem.variables) problem.box.push_back(box[variable.index()]);
  problem.objective = Compile(problem.form, problem.variables);
  problem.constrained.assign(problem.variables.size(), false);
  return problem;
}

Glance Look(const Expression& e, double sign, std::span<const Interval> box, double limit) {
  const Interval range = Interval{sign, sign} * Evaluate(e, box);
  Glance glance = {.bound = range.high, .attained = -kInfinity};
  if (glance.bound < limit || e.IsConstant()) return {range.high, range.low};
  const Maximization problem = AsItStands(e, sign, box);
  Probe probe(problem);
  const MonotoneBox monotone = SetMonotoneVariables(probe, problem.box);
  glance.bound = std::min(glance.bound, monotone.range.high);
  if (!probe.over_box().DefinedEverywhere()) return glance;
  const double centred = CentredUpperBound(probe, monotone.box, monotone.gradient);
  glance.bound = std::min(glance.bound, centred);
  probe.Offer(AscendToCorner(probe, monotone.box));
  glance.attained = probe.best_value();
  return glance;
}

}  // namespace

Glance GlanceAbove(const Expression& e, std::span<const Interval> box, double limit) {
  return Look(e, 1, box, limit);
}

Glance GlanceBelow(const Expression& e, std::span<const Interval> box, double limit) {
  const Glance mirrored = Look(e, -1, box, -limit);
  return {-mirrored.bound, -mirrored.attained};
}

}  // namespace assay::algebra
