#include "planner/algebra/bounding_methods/affine_form.h"

#include <cmath>

#include "planner/algebra/bounding_methods/glance.h"
#include "planner/algebra/bounds/probe.h"
#include "planner/algebra/compiled_forms/compiler.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

// Returns the derivatives of e at the middle of the box, in the order of `variables`.
std::vector<double> SlopesAtTheMiddle(const Expression& e, std::span<const VariableId> variables,
                                      std::span<const Interval> box) {
  std::vector<double> middle;
  for (const VariableId v : variables) middle.push_back(Midpoint(box[v.index()]));
  const NormalForm as_it_stands = {
      {{.coefficient = {1, 1}, .factors = {{.atom = e, .exponent = 1}}}}};
  const CompiledForm form = Compile(as_it_stands, variables);
  Derivatives<double> derivatives(form);
  derivatives.Value(middle);
  return derivatives.Gradient();
}

}  // namespace

AffineForm AffineFormOf(const Expression& e, std::span<const Interval> box, double negligible) {
  if (e.IsConstant()) return {0, {e.constant(), e.constant()}};
  const std::vector<VariableId> variables = VariablesOf(e);
  const std::vector<double> slopes = SlopesAtTheMiddle(e, variables, box);
  const auto moves = [&](std::size_t i) {
    return std::abs(slopes[i]) * Width(box[variables[i].index()]);
  };
  double all = 0;
  for (std::size_t i = 0; i < variables.size(); ++i) all += moves(i);
  Expression linear = 0;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (!std::isfinite(slopes[i]) || moves(i) < negligible * all) continue;
    linear = linear + slopes[i] * e.pool()->Variable(variables[i]);
  }
  const Expression rest = e - linear;
  return {linear,
          {GlanceBelow(rest, box, kInfinity).bound, GlanceAbove(rest, box, -kInfinity).bound}};
}

}  // namespace assay::algebra
