#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "planner/base/intern_table.h"

namespace assay::contingent {

// A node of a reduced ordered binary decision diagram (Bryant 1986), which is a set of truth
// assignments. Equal sets are the same node, so sets are compared and hashed by their number.
using Diagram = std::int32_t;
constexpr Diagram kEmptySet = 0;  // the constant false
constexpr Diagram kAllSets = 1;   // the constant true

// A variable and its value.
struct Assignment {
  int variable = 0;
  bool value = true;

  bool operator==(const Assignment&) const = default;
};

// Diagrams over the variables 0, 1, ..., ordered by number. Nodes are never freed, because a search
// needs few of them.
class DecisionDiagrams {
 public:
  DecisionDiagrams();

  Diagram Literal(Assignment literal);
  Diagram Not(Diagram f) { return IfThenElse(f, kEmptySet, kAllSets); }
  Diagram And(Diagram f, Diagram g) { return IfThenElse(f, g, kEmptySet); }
  Diagram Or(Diagram f, Diagram g) { return IfThenElse(f, kAllSets, g); }
  Diagram Equal(Diagram f, Diagram g) { return IfThenElse(f, g, Not(g)); }
  Diagram IfThenElse(Diagram f, Diagram g, Diagram h);
  // Returns true if f is a subset of g. Makes no nodes.
  bool Implies(Diagram f, Diagram g) const;

  // Return the assignments in which exactly one, or at least one, of the literals holds.
  Diagram ExactlyOne(std::span<const Assignment> literals);
  Diagram AtLeastOne(std::span<const Assignment> literals);

  // Returns f where the literal holds. The result does not depend on the literal's variable.
  Diagram Cofactor(Diagram f, Assignment literal) { return Restrict(f, {literal}); }
  // Returns f where all literals hold. The literals are sorted by variable.
  Diagram Restrict(Diagram f, const std::vector<Assignment>& literals);
  // Returns f with each variable x in `of` replaced by the diagram of[x], all at once.
  Diagram Compose(Diagram f, const std::unordered_map<int, Diagram>& of);
  Diagram Exists(Diagram f, int variable);
  Diagram ForAll(Diagram f, int variable);

  // Returns the literals that hold in every assignment of the set f. The set must not be empty.
  const std::vector<Assignment>& Essential(Diagram f);
  // Returns the variables that f depends on, sorted.
  const std::vector<int>& Support(Diagram f);

  bool IsConstant(Diagram f) const { return f <= kAllSets; }
  int variable(Diagram f) const { return nodes_[f].variable; }
  Diagram low(Diagram f) const { return nodes_[f].low; }    // the part where the variable is false
  Diagram high(Diagram f) const { return nodes_[f].high; }  // the part where the variable is true

 private:
  struct Node {
    int variable;
    Diagram low;
    Diagram high;
  };
  struct Computed {
    Diagram f = -1, g = -1, h = -1, result = -1;
  };

  bool ImpliesBesides(Diagram f, Diagram g, std::unordered_set<std::uint64_t>& implied) const;
  Diagram Make(int variable, Diagram low, Diagram high);
  Diagram Branch(Diagram f, int variable, bool value) const;
  Diagram RestrictFrom(Diagram f, std::span<const Assignment> literals,
                       std::unordered_map<Diagram, Diagram>& done);
  Diagram ComposeWith(Diagram f, const std::unordered_map<int, Diagram>& of,
                      std::unordered_map<Diagram, Diagram>& done);

  std::vector<Node> nodes_;
  InternTable unique_;
  // A cache of IfThenElse. Each place holds the last result that was stored there.
  std::vector<Computed> computed_;
  std::unordered_map<Diagram, std::vector<Assignment>> essential_;
  std::unordered_map<Diagram, std::vector<int>> support_;
  std::vector<int> marks_;  // by node: the last traversal that reached it
  int mark_ = 0;
};

}  // namespace assay::contingent
