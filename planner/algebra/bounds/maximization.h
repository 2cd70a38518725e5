#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/forms/compiled_form.h"
#include "planner/algebra/linear/constraint_set.h"

namespace assay::algebra {

// The question behind every bound: how large can a form become over a box, where some inequalities
// hold? A variable has a number of its own here: its place in `variables`.
struct Maximization {
  NormalForm form;
  std::vector<VariableId> variables;  // that occur in the form or an inequality, increasing
  std::vector<Interval> box;          // by number
  CompiledForm objective;
  std::vector<CompiledForm> slacks;  // of each inequality: none is negative where all hold
  std::vector<bool> constrained;     // by number: occurs in an inequality
  std::vector<double> elsewhere;     // by VariableId: a coordinate for those without a number
  // The expression before it was brought to normal form, by VariableId, if it may be undefined: the
  // normal form can have a value where it has none, as sqrt(x)^2 = x.
  std::optional<CompiledForm> as_written;
};

// Of e (sign = 1) or of -e (sign = -1).
Maximization MaximizationOf(const Expression& e, int sign, const ConstraintSet& constraints);
// With the normal form of e, where it is known.
Maximization MaximizationOf(const Expression& e, NormalForm form, int sign,
                            const ConstraintSet& constraints);

// The same over a smaller box, where the form is defined everywhere. If there are no inequalities,
// atoms that are left no freedom go into the coefficients.
Maximization Restricted(const Maximization& problem, std::span<const Interval> box);

// The coordinates of the numbered variables with all others', by VariableId.
std::vector<double> FullPoint(const Maximization& problem, std::span<const double> point);

}  // namespace assay::algebra
