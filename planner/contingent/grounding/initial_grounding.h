#pragma once

#include <map>
#include <string>

#include "planner/contingent/grounding/effect_grounding.h"

namespace assay::contingent {

// Grounds the init of a problem.
class InitialGrounding {
 public:
  InitialGrounding(const Problem& problem, TermGrounding& terms, EffectGrounding& effects)
      : problem_(problem), terms_(terms), effects_(effects) {}

  // Tells the atom table which atoms init knows. It must be called before all other grounding.
  // Throws InputError at a change that contradicts the changes before it.
  void Tell();
  // Makes the task's initial knowledge. It must be called after all other grounding, when all atoms
  // exist.
  void Ground();

 private:
  void TellUnknown(const Change& change);
  void TellFact(const Change& change);
  void TellAtom(const std::string& atom, Knowledge knowledge, Place place);
  void RequireValue(FunctionId function, Place place) const;
  void Ground(const Change& change);
  void AddRelation(const GroundChange& change, Place place);
  void GroundRanges();
  void NarrowRange(const GroundChange& change, Place place);
  void NarrowRange(const Bound& bound, Place place);
  Range& RangeOf(FunctionId function);

  [[noreturn]] void FailContradiction(Place place, const std::string& what) const;

  const Problem& problem_;
  TermGrounding& terms_;
  EffectGrounding& effects_;
  // The knowledge that init puts in Kf. The atom table also records the alternatives of Kx as
  // unknown, so that LCW does not close them.
  std::map<std::string, Knowledge> stated_;
};

}  // namespace assay::contingent
