#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace assay::algebra {

// A sum of products of atoms, no atom twice in one product, nested as Horner does: the first atom
// of its terms is taken out of them, so on with what it multiplies. c + d*x + e*x*y + f*y becomes
// c + x*(d + e*y) + f*y. In flat arrays, for many evaluations.
class NestedForm {
 public:
  static constexpr int kMostAtoms = 64;

  // The set of a product's atoms: the smaller the atom's number, the more significant its bit.
  using AtomSet = std::uint64_t;
  static AtomSet SetOf(int atom) { return AtomSet{1} << (kMostAtoms - 1 - atom); }

  struct Term {
    AtomSet atoms = 0;
    double coefficient = 0;
  };

  // A sum; of its leaves and branches it holds those from where the node before ended.
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
    int node = 0;  // smaller than the number of the node that the branch is of
  };

  // Sorts the terms, and merges those of equal sets of atoms.
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

  std::vector<Node> nodes_;  // the last one is the form
  std::vector<Leaf> leaves_;
  std::vector<Branch> branches_;
  std::vector<Branch> pending_;  // branches of nodes that are not there yet
};

// What is left of forms once the values of some atoms are known.
class NestedReduction {
 public:
  // scale * form, with the values by atom of those that are not free. Returns the atoms that are
  // left in it.
  NestedForm::AtomSet Reduce(const NestedForm& form, double scale, NestedForm::AtomSet free,
                             std::span<const double> values, NestedForm& reduced);

 private:
  std::vector<NestedForm::Term> outer_;  // by node: what stands before it
  std::vector<NestedForm::Term> terms_;
};

// The value of a nested form and its derivatives by the atoms, with room that is used again and
// again. Number: double or NearestInterval.
template <class Number>
class NestedEvaluation {
 public:
  // `atoms`: the place, by atom; also below.
  Number Value(const NestedForm& form, std::span<const Number> atoms);
  // After Value at the same place: one pass back.
  const std::vector<Number>& Slopes(const NestedForm& form, std::span<const Number> atoms);
  // How the slopes change along the tangent, also by atom; after Slopes at the same place.
  const std::vector<Number>& SlopesAlong(const NestedForm& form, std::span<const Number> atoms,
                                         std::span<const Number> tangent);

 private:
  void ValueAlong(const NestedForm& form, std::span<const Number> atoms,
                  std::span<const Number> tangent);

  std::vector<Number> value_, adjoint_;              // by node
  std::vector<Number> value_along_, adjoint_along_;  // by node
  std::vector<Number> slopes_, slopes_along_;        // by atom
};

}  // namespace assay::algebra
