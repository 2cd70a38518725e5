#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace assay::algebra {

// A sum of products of atoms, nested as in Horner's scheme. No atom occurs twice in one product.
// The first atom of a group of terms is factored out, and the remaining sum is nested recursively:
// c + d*x + e*x*y + f*y becomes c + x*(d + e*y) + f*y. The form is stored in flat arrays, for many
// evaluations.
class NestedForm {
 public:
  static constexpr int kMostAtoms = 64;

  // The set of a product's atoms. An atom with a smaller number has a more significant bit.
  using AtomSet = std::uint64_t;
  static AtomSet SetOf(int atom) { return AtomSet{1} << (kMostAtoms - 1 - atom); }

  struct Term {
    AtomSet atoms = 0;
    double coefficient = 0;
  };

  // A sum of a constant, leaves and branches. Its leaves (branches) begin where those of the
  // preceding node end, and end before leaves_end (branches_end).
  struct Node {
    double constant = 0;
    int leaves_end = 0;
    int branches_end = 0;
  };
  struct Leaf {
    double coefficient = 0;
    int atom = 0;
  };
  struct Branch {
    int atom = 0;
    int node = 0;  // smaller than the number of the node that the branch belongs to
  };

  // Builds the form. Sorts the given terms and merges those with equal sets of atoms.
  void Assign(std::vector<Term>& terms);

  int node_count() const { return static_cast<int>(nodes_.size()); }
  double constant(int node) const { return nodes_[node].constant; }
  std::span<const Leaf> leaves(int node) const {
    const int begin = node == 0 ? 0 : nodes_[node - 1].leaves_end;
    return {leaves_.data() + begin, leaves_.data() + nodes_[node].leaves_end};
  }
  std::span<const Branch> branches(int node) const {
    const int begin = node == 0 ? 0 : nodes_[node - 1].branches_end;
    return {branches_.data() + begin, branches_.data() + nodes_[node].branches_end};
  }

 private:
  int Nest(std::span<const Term> terms, AtomSet rest);

  std::vector<Node> nodes_;  // the last one is the whole form
  std::vector<Leaf> leaves_;
  std::vector<Branch> branches_;
  std::vector<Branch> pending_;  // branches of nodes that are still being built
};

// Substitutes known values for some atoms of a form. The object owns scratch memory that is reused.
class NestedReduction {
 public:
  // Sets `reduced` to scale * form, in which the atoms outside `free` are replaced by their values.
  // `values` is indexed by atom and read only for replaced atoms. Returns the set of the atoms that
  // remain.
  NestedForm::AtomSet Reduce(const NestedForm& form, double scale, NestedForm::AtomSet free,
                             std::span<const double> values, NestedForm& reduced);

 private:
  std::vector<NestedForm::Term> outer_;  // indexed by node: the product of its multipliers
  std::vector<NestedForm::Term> terms_;
};

// Computes the value of a nested form and its derivatives with respect to the atoms. Its memory is
// reused from one evaluation to the next. Number is double or NearestInterval.
template <class Number>
class NestedEvaluation {
 public:
  // Returns the value at `atoms`, which holds the value of each atom.
  Number Value(const NestedForm& form, std::span<const Number> atoms);
  // Returns the derivatives with respect to the atoms, in one backward pass. Call Value at the same
  // place first.
  const std::vector<Number>& Slopes(const NestedForm& form, std::span<const Number> atoms);
  // Returns the directional derivative of the slopes along the tangent. The result and `tangent`
  // are indexed by atom. Call Slopes at the same place first.
  const std::vector<Number>& SlopesAlong(const NestedForm& form, std::span<const Number> atoms,
                                         std::span<const Number> tangent);

 private:
  void ValueAlong(const NestedForm& form, std::span<const Number> atoms,
                  std::span<const Number> tangent);

  std::vector<Number> value_, adjoint_;              // indexed by node
  std::vector<Number> value_along_, adjoint_along_;  // indexed by node
  std::vector<Number> slopes_, slopes_along_;        // indexed by atom
};

}  // namespace assay::algebra
