#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/world_sets/decision_diagram.h"

namespace assay::contingent {

// The knowledge of the planner. It consists of the stores of PKS (Petrick and Bacchus 2002), each
// in canonical form, so that equal knowledge is equal data:
//   Kf   literals that are known, as bits; intervals of numeric functions
//   Kw   formulas whose truth will be known at run time and is not known at plan time
//   Kv   functions whose value will be known at run time and is not known at plan time
//   Kx   relations among the unknown atoms. PKS has exclusive alternatives. Here they are any
//        relations, as diagrams over disjoint sets of unknown atoms. They include knowledge of
//        the past: after "where C, l" with C unknown, l and C are related, and learning the one
//        settles the other (postdiction, Petrick and Bacchus 2004).
//   LCW  closes the initial state, and defines what an action that senses all instances senses.
//        Grounding (grounding.h) resolves it, so a state does not contain it.
struct KnowledgeState {
  std::vector<std::uint64_t> bits;  // bits in the order of StateLayout
  std::vector<Diagram> relations;   // Kx, sorted
  std::vector<Range> ranges;        // intervals of numeric functions, by slot

  bool operator==(const KnowledgeState&) const = default;
};

std::uint64_t HashOf(const KnowledgeState& state);

// The layout of a state's bits: Kf true, Kf false, Kw, Kv, entangled atoms and outer atoms. An
// entangled atom is an unknown atom that depends on a number, because an unknown bound has decided
// its value. No relation records this dependence. New knowledge of the number may say something
// about the atom that the state does not say. The atom is outer then, as a number's range can be
// (Range::is_outer).
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
  // Marks all entangled atoms as outer.
  void SetEntangledOuter(KnowledgeState& state) const {
    for (std::size_t w = 0; w < atom_words_; ++w) {
      state.bits[FirstEntangled() + atom_words_ + w] |= state.bits[FirstEntangled() + w];
    }
  }
  // Clears both marks of all known atoms: only unknown atoms can be entangled or outer.
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
