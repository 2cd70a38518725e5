#include "planner/algebra/bounds/maximization.h"

#include <algorithm>
#include <map>
#include <utility>

#include "planner/algebra/compiled_forms/compiler.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/normal_forms/normalization.h"
#include "planner/base/check.h"
#include "planner/base/index_map.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

using Factor = NormalForm::Factor;
using FactorKeys = std::vector<std::pair<int, int>>;  // the atoms' indices and exponents

// Adds the form's variables to the given ones and keeps the list in increasing order.
void InsertVariables(const NormalForm& form, std::vector<VariableId>& variables) {
  IndexMap<bool> seen;  // atoms whose variables have been added
  for (const NormalForm::Term& term : form.terms) {
    for (const Factor& factor : term.factors) {
      if (std::exchange(seen[factor.atom.index()], true)) continue;
      const std::vector<VariableId> own = VariablesOfAtom(factor.atom);
      variables.insert(variables.end(), own.begin(), own.end());
    }
  }
  std::ranges::sort(variables);
  const auto repeated = std::ranges::unique(variables);
  variables.erase(repeated.begin(), repeated.end());
}

NormalForm Negated(NormalForm form) {
  for (NormalForm::Term& term : form.terms) term.coefficient = -term.coefficient;
  return form;
}

std::optional<CompiledForm> AsWritten(const Expression& e, std::size_t variables) {
  if (!e.MayBeUndefined()) return std::nullopt;
  std::vector<VariableId> all;
  for (std::size_t i = 0; i < variables; ++i) all.emplace_back(i);
  return Compile({{{.coefficient = {1, 1}, .factors = {{.atom = e, .exponent = 1}}}}}, all);
}

void CheckBox(const ConstraintSet& constraints, std::span<const VariableId> variables) {
  for (VariableId variable : variables) {
    ASSAY_CHECK(variable.index() < static_cast<int>(constraints.box.size()),
                "the box has no interval for variable {}", variable.index());
    const Interval& interval = constraints.box[variable.index()];
    ASSAY_CHECK(interval.low <= interval.high, "bounds of variable {} are [{}, {}]",
                variable.index(), interval.low, interval.high);
  }
}

void FillIn(Maximization& problem, std::vector<VariableId> variables,
            std::span<const Interval> box_by_id) {
  problem.variables = std::move(variables);
  for (VariableId variable : problem.variables) {
    problem.box.push_back(box_by_id[variable.index()]);
  }
  problem.objective = Compile(problem.form, problem.variables);
}

// The values of atoms that are constant over the box. Each atom is evaluated once.
class FixedAtoms {
 public:
  explicit FixedAtoms(std::span<const Interval> box) : box_(box) {}

  // Returns null if the atom varies over the box.
  const Interval* Find(const Expression& atom) {
    const auto [at, is_new] = values_.try_emplace(atom.index());
    if (is_new && !Varies(atom)) at->second = {true, Evaluate(atom, box_)};
    return at->second.first ? &at->second.second : nullptr;
  }

 private:
  bool Varies(const Expression& atom) const {
    const std::vector<VariableId> variables = VariablesOfAtom(atom);
    return std::any_of(variables.begin(), variables.end(), [&](VariableId variable) {
      return box_[variable.index()].low != box_[variable.index()].high;
    });
  }

  std::span<const Interval> box_;  // indexed by VariableId
  std::map<int, std::pair<bool, Interval>> values_;
};

NormalForm WithFixedAtoms(const NormalForm& form, std::span<const Interval> box_by_id) {
  FixedAtoms fixed(box_by_id);
  std::map<FactorKeys, NormalForm::Term> merged;
  for (const NormalForm::Term& term : form.terms) {
    NormalForm::Term rest{term.coefficient, {}};
    FactorKeys keys;
    for (const Factor& factor : term.factors) {
      if (const Interval* value = fixed.Find(factor.atom)) {
        rest.coefficient = rest.coefficient * Power(*value, factor.exponent);
      } else {
        rest.factors.push_back(factor);
        keys.emplace_back(factor.atom.index(), factor.exponent);
      }
    }
    const auto [at, is_new] = merged.try_emplace(std::move(keys), rest);
    if (!is_new) at->second.coefficient = at->second.coefficient + rest.coefficient;
  }
  NormalForm result;
  for (auto& [keys, term] : merged) result.terms.push_back(std::move(term));
  return result;
}

std::vector<bool> Constrained(std::span<const VariableId> variables,
                              std::span<const VariableId> in_inequalities) {
  std::vector<bool> constrained;
  for (VariableId variable : variables) {
    constrained.push_back(std::ranges::binary_search(in_inequalities, variable));
  }
  return constrained;
}

}  // namespace

Maximization MaximizationOf(const Expression& e, int sign, const ConstraintSet& constraints) {
  return MaximizationOf(e, NormalFormOf(e), sign, constraints);
}

Maximization MaximizationOf(const Expression& e, NormalForm form, int sign,
                            const ConstraintSet& constraints) {
  Maximization problem;
  problem.form = sign < 0 ? Negated(std::move(form)) : std::move(form);
  std::vector<NormalForm> slacks;
  std::vector<VariableId> in_inequalities;
  for (const Inequality& inequality : constraints.inequalities) {
    slacks.push_back(NormalFormOf(inequality.greater - inequality.lesser));
    InsertVariables(slacks.back(), in_inequalities);
  }
  std::vector<VariableId> variables = in_inequalities;
  InsertVariables(problem.form, variables);
  CheckBox(constraints, variables);
  FillIn(problem, std::move(variables), constraints.box);
  for (const NormalForm& slack : slacks) {
    problem.slacks.push_back(Compile(slack, problem.variables));
  }
  problem.constrained = Constrained(problem.variables, in_inequalities);
  problem.elsewhere.reserve(constraints.box.size());
  for (const Interval& interval : constraints.box) {
    problem.elsewhere.push_back(Midpoint(interval));
  }
  problem.as_written = AsWritten(e, constraints.box.size());
  return problem;
}

Maximization Restricted(const Maximization& problem, std::span<const Interval> box) {
  if (!problem.slacks.empty()) {
    Maximization same = problem;
    same.box.assign(box.begin(), box.end());
    return same;
  }
  Maximization restricted;
  restricted.elsewhere = problem.elsewhere;
  restricted.as_written = problem.as_written;
  std::vector<Interval> box_by_id(problem.elsewhere.size());
  for (std::size_t i = 0; i < box.size(); ++i) {
    const int id = problem.variables[i].index();
    box_by_id[id] = box[i];
    restricted.elsewhere[id] = Midpoint(box[i]);
  }
  restricted.form = WithFixedAtoms(problem.form, box_by_id);
  std::vector<VariableId> variables;
  InsertVariables(restricted.form, variables);
  FillIn(restricted, std::move(variables), box_by_id);
  restricted.constrained.assign(restricted.variables.size(), false);
  return restricted;
}

std::vector<double> FullPoint(const Maximization& problem, std::span<const double> point) {
  std::vector<double> full = problem.elsewhere;
  for (std::size_t i = 0; i < point.size(); ++i) full[problem.variables[i].index()] = point[i];
  return full;
}

}  // namespace assay::algebra
