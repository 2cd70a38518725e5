#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/compiled_forms/compiled_form.h"
#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/algebra/sup_inf/constraint_set.h"

namespace assay::algebra {

// The problem behind every bound: how large can a form become over a box in which some inequalities
// hold? The number of a variable is its place in `variables`.
struct Maximization {
  NormalForm form;
  std::vector<VariableId> variables;  // increasing: all that occur in the form or in an inequality
  std::vector<Interval> box;          // indexed by number
  CompiledForm objective;
  // One slack for each inequality. All slacks are >= 0 where all inequalities hold.
  std::vector<CompiledForm> slacks;
  std::vector<bool> constrained;  // indexed by number: the variable occurs in an inequality
  // A coordinate for each variable without a number, indexed by VariableId.
  std::vector<double> elsewhere;
  // The expression before it was brought to normal form. Its variables are indexed by VariableId.
  // It is kept only if it may be undefined, because the normal form can have a value where the
  // expression has none, as for sqrt(x)^2 = x.
  std::optional<CompiledForm> as_written;
};

// Returns the problem of maximizing e (sign = 1) or -e (sign = -1).
Maximization MaximizationOf(const Expression& e, int sign, const ConstraintSet& constraints);
// Returns the problem for an expression whose normal form is already known.
Maximization MaximizationOf(const Expression& e, NormalForm form, int sign,
                            const ConstraintSet& constraints);

// Returns the problem over a smaller box in which the form is defined everywhere. If there are no
// inequalities, atoms that are constant over the smaller box are multiplied into the coefficients.
Maximization Restricted(const Maximization& problem, std::span<const Interval> box);

// Returns a point indexed by VariableId: the given coordinates of the numbered variables, and
// `elsewhere` for all others.
std::vector<double> FullPoint(const Maximization& problem, std::span<const double> point);

}  // namespace assay::algebra
