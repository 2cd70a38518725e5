#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/worlds/decision_diagram.h"

namespace assay::contingent {

// What the planner knows. The stores of PKS (Petrick and Bacchus 2002), each in canonical form, so
// that equal knowledge is equal data:
//   Kf   literals that are known, as bits; intervals of numeric functions
//   Kw   formulas whose truth will be known at run time and is not yet at plan time
//   Kv   functions whose value will be known at run time and is not yet at plan time
//   Kx   what relates the unknown atoms. In PKS exclusive alternatives; here any relation, as
//        diagrams over disjoint sets of unknown atoms. It also holds what is known of the past:
//        after "where C, l" with C unknown, l and C are related, and learning the one settles the
//        other (postdiction, Petrick and Bacchus 2004).
//   LCW  closes the initial state, and tells what an action that senses all instances senses
//        (grounding.h); nothing of it is left to be kept here.
struct KnowledgeState {
  std::vector<std::uint64_t> bits;  // by StateLayout
  std::vector<Diagram> relations;   // Kx, sorted
  std::vector<Range> ranges;        // of numeric functions, by slot

  bool operator==(const KnowledgeState&) const = default;
};

std::uint64_t HashOf(const KnowledgeState& state);

// Where the bits of a state are: Kf true, Kf false, Kw, Kv; and of unknown atoms, which hang
// together with numbers: a bound that is not known has decided what they are. No relation says how:
// when more is learned of such a number, that may tell of the atom what the state does not say, and
// the atom is outer, as a number's range is (Range::is_outer).
class StateLayout {
 public:
  explicit StateLayout(const GroundTask& task)
      : atom_words_(Words(task.atoms.size())),
        formula_words_(Words(task.formulas.size())),
        function_words_(Words(task.functions.size())) {}

  std::size_t size() const { return 4 * atom_words_ + formula_words_ + function_words_; }

  bool IsKnown(const KnowledgeState& state, GroundLiteral literal) const {
    return Bit(state, At(literal), literal.atom.index());
  }
  bool IsUndetermined(const KnowledgeState& state, AtomId atom) const {
    return !IsKnown(state, {atom, true}) && !IsKnown(state, {atom, false});
  }
  bool IsSensed(const KnowledgeState& state, FormulaId formula) const {
    return Bit(state, 2 * atom_words_, formula.index());
  }
  bool IsSensed(const KnowledgeState& state, FunctionId function) const {
    return Bit(state, 2 * atom_words_ + formula_words_, function.index());
  }
  bool IsEntangled(const KnowledgeState& state, AtomId atom) const {
    return Bit(state, FirstEntangled(), atom.index());
  }
  bool IsOuter(const KnowledgeState& state, AtomId atom) const {
    return Bit(state, FirstEntangled() + atom_words_, atom.index());
  }

  void SetKnown(KnowledgeState& state, GroundLiteral literal) const {
    SetBit(state, At(literal), literal.atom.index(), true);
    SetBit(state, At({literal.atom, !literal.is_positive}), literal.atom.index(), false);
  }
  void SetUnknown(KnowledgeState& state, AtomId atom) const {
    SetBit(state, At({atom, true}), atom.index(), false);
    SetBit(state, At({atom, false}), atom.index(), false);
  }
  void SetSensed(KnowledgeState& state, FormulaId formula, bool value) const {
    SetBit(state, 2 * atom_words_, formula.index(), value);
  }
  void SetSensed(KnowledgeState& state, FunctionId function, bool value) const {
    SetBit(state, 2 * atom_words_ + formula_words_, function.index(), value);
  }
  void SetEntangled(KnowledgeState& state, AtomId atom, bool value) const {
    SetBit(state, FirstEntangled(), atom.index(), value);
  }
  void SetOuter(KnowledgeState& state, AtomId atom, bool value) const {
    SetBit(state, FirstEntangled() + atom_words_, atom.index(), value);
  }
  // All atoms that are entangled are outer from now on.
  void SetEntangledOuter(KnowledgeState& state) const {
    for (std::size_t w = 0; w < atom_words_; ++w) {
      state.bits[FirstEntangled() + atom_words_ + w] |= state.bits[FirstEntangled() + w];
    }
  }
  // What is known is neither.
  void DisentangleKnown(KnowledgeState& state) const {
    for (std::size_t w = 0; w < atom_words_; ++w) {
      const std::uint64_t unknown = ~(state.bits[w] | state.bits[atom_words_ + w]);
      state.bits[FirstEntangled() + w] &= unknown;
      state.bits[FirstEntangled() + atom_words_ + w] &= unknown;
    }
  }

 private:
  std::size_t FirstEntangled() const { return 2 * atom_words_ + formula_words_ + function_words_; }
  static std::size_t Words(std::size_t bits) { return (bits + 63) / 64; }
  std::size_t At(GroundLiteral literal) const { return literal.is_positive ? 0 : atom_words_; }
  static bool Bit(const KnowledgeState& state, std::size_t from, int index) {
    return (state.bits[from + index / 64] >> (index % 64) & 1U) != 0;
  }
  static void SetBit(KnowledgeState& state, std::size_t from, int index, bool value) {
    std::uint64_t& word = state.bits[from + index / 64];
    const std::uint64_t bit = std::uint64_t{1} << (index % 64);
    word = value ? word | bit : word & ~bit;
  }

  std::size_t atom_words_;
  std::size_t formula_words_;
  std::size_t function_words_;
};

}  // namespace assay::contingent
