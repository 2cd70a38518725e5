#include "planner/algebra/multiaffine/nested_form.h"

#include <algorithm>
#include <bit>

#include "planner/numeric/nearest_interval.h"

namespace assay::algebra {
namespace {

using AtomSet = NestedForm::AtomSet;
using Term = NestedForm::Term;

// Merges terms with equal sets of atoms. The terms must be sorted.
void MergeEqualTerms(std::vector<Term>& terms) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (count > 0 && terms[count - 1].atoms == terms[i].atoms) {
      terms[count - 1].coefficient += terms[i].coefficient;
    } else {
      terms[count++] = terms[i];
    }
  }
  terms.resize(count);
}

}  // namespace

void NestedForm::Assign(std::vector<Term>& terms) {
  nodes_.clear();
  leaves_.clear();
  branches_.clear();
  std::sort(terms.begin(), terms.end(),
            [](const Term& a, const Term& b) { return a.atoms > b.atoms; });
  MergeEqualTerms(terms);
  Nest(terms, ~AtomSet{0});
}

// Adds the node for sorted terms and returns its number. Only the atoms in `rest` count; because of
// the order, terms with the same first atom are adjacent. The nodes of branches are added before
// the node itself, so that each node's leaves and branches are contiguous.
int NestedForm::Nest(std::span<const Term> terms, AtomSet rest) {
  const std::size_t first_pending = pending_.size();
  const auto for_each_first_atom = [&](const auto& visit) {
    for (std::size_t begin = 0; begin < terms.size();) {
      const int atom = std::countl_zero(terms[begin].atoms & rest);
      std::size_t end = begin + 1;
      while (end < terms.size() && std::countl_zero(terms[end].atoms & rest) == atom) ++end;
      visit(atom, terms.subspan(begin, end - begin));
      begin = end;
    }
  };
  const auto is_leaf = [&](int atom, std::span<const Term> sharing) {
    return sharing.size() == 1 && (sharing[0].atoms & rest) == SetOf(atom);
  };
  for_each_first_atom([&](int atom, std::span<const Term> sharing) {
    if (atom == kMostAtoms || is_leaf(atom, sharing)) return;
    pending_.push_back({atom, Nest(sharing, SetOf(atom) - 1)});
  });
  double constant = 0;
  for_each_first_atom([&](int atom, std::span<const Term> sharing) {
    if (atom == kMostAtoms) {
      constant = sharing[0].coefficient;
    } else if (is_leaf(atom, sharing)) {
      leaves_.push_back({sharing[0].coefficient, atom});
    }
  });
  branches_.insert(branches_.end(), pending_.begin() + first_pending, pending_.end());
  pending_.resize(first_pending);
  nodes_.push_back(
      {constant, static_cast<int>(leaves_.size()), static_cast<int>(branches_.size())});
  return node_count() - 1;
}

AtomSet NestedReduction::Reduce(const NestedForm& form, double scale, AtomSet free,
                                std::span<const double> values, NestedForm& reduced) {
  const auto product = [&](Term term, int atom, double coefficient) {
    const AtomSet set = NestedForm::SetOf(atom);
    const bool is_free = (free & set) != 0;
    return Term{
        is_free ? term.atoms | set : term.atoms,
        is_free ? term.coefficient * coefficient : term.coefficient * coefficient * values[atom]};
  };
  terms_.clear();
  outer_.resize(form.node_count());
  outer_.back() = {.atoms = 0, .coefficient = scale};
  AtomSet left = 0;
  for (int node = form.node_count() - 1; node >= 0; --node) {
    const Term outer = outer_[node];
    const auto add = [&](const Term& term) {
      terms_.push_back(term);
      left |= term.atoms;
    };
    add({outer.atoms, outer.coefficient * form.constant(node)});
    for (const auto& leaf : form.leaves(node)) add(product(outer, leaf.atom, leaf.coefficient));
    for (const auto& branch : form.branches(node)) {
      outer_[branch.node] = product(outer, branch.atom, 1);
    }
  }
  reduced.Assign(terms_);
  return left;
}

template <class Number>
Number NestedEvaluation<Number>::Value(const NestedForm& form, std::span<const Number> atoms) {
  value_.resize(form.node_count());
  for (int node = 0; node < form.node_count(); ++node) {
    Number sum = form.constant(node);
    for (const auto& leaf : form.leaves(node)) sum += leaf.coefficient * atoms[leaf.atom];
    for (const auto& branch : form.branches(node)) sum += atoms[branch.atom] * value_[branch.node];
    value_[node] = sum;
  }
  return value_.back();
}

template <class Number>
const std::vector<Number>& NestedEvaluation<Number>::Slopes(const NestedForm& form,
                                                            std::span<const Number> atoms) {
  adjoint_.resize(form.node_count());
  slopes_.assign(atoms.size(), Number(0));
  adjoint_.back() = 1;
  for (int node = form.node_count() - 1; node >= 0; --node) {
    const Number adjoint = adjoint_[node];
    for (const auto& leaf : form.leaves(node)) slopes_[leaf.atom] += leaf.coefficient * adjoint;
    for (const auto& branch : form.branches(node)) {
      slopes_[branch.atom] += adjoint * value_[branch.node];
      adjoint_[branch.node] = adjoint * atoms[branch.atom];
    }
  }
  return slopes_;
}

template <class Number>
void NestedEvaluation<Number>::ValueAlong(const NestedForm& form, std::span<const Number> atoms,
                                          std::span<const Number> tangent) {
  value_along_.resize(form.node_count());
  for (int node = 0; node < form.node_count(); ++node) {
    Number sum = 0;
    for (const auto& leaf : form.leaves(node)) sum += leaf.coefficient * tangent[leaf.atom];
    for (const auto& branch : form.branches(node)) {
      sum += tangent[branch.atom] * value_[branch.node];
      sum += atoms[branch.atom] * value_along_[branch.node];
    }
    value_along_[node] = sum;
  }
}

template <class Number>
const std::vector<Number>& NestedEvaluation<Number>::SlopesAlong(const NestedForm& form,
                                                                 std::span<const Number> atoms,
                                                                 std::span<const Number> tangent) {
  ValueAlong(form, atoms, tangent);
  adjoint_along_.resize(form.node_count());
  slopes_along_.assign(atoms.size(), Number(0));
  adjoint_along_.back() = 0;
  for (int node = form.node_count() - 1; node >= 0; --node) {
    const Number adjoint = adjoint_[node];
    const Number along = adjoint_along_[node];
    for (const auto& leaf : form.leaves(node)) slopes_along_[leaf.atom] += leaf.coefficient * along;
    for (const auto& branch : form.branches(node)) {
      slopes_along_[branch.atom] += along * value_[branch.node];
      slopes_along_[branch.atom] += adjoint * value_along_[branch.node];
      adjoint_along_[branch.node] = along * atoms[branch.atom];
      adjoint_along_[branch.node] += adjoint * tangent[branch.atom];
    }
  }
  return slopes_along_;
}

template class NestedEvaluation<double>;
template class NestedEvaluation<numeric::NearestInterval>;

}  // namespace assay::algebra
