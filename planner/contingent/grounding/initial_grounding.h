#pragma once

#include <map>
#include <string>

#include "planner/contingent/grounding/effect_grounding.h"

namespace assay::contingent {

// What a problem's init says.
class InitialGrounding {
 public:
  InitialGrounding(const Problem& problem, TermGrounding& terms, EffectGrounding& effects)
      : problem_(problem), terms_(terms), effects_(effects) {}

  // Comes before all else: tells the table which atoms are always known. Throws InputError, as does
  // Ground, at a change that contradicts those before it.
  void Tell();
  // Comes after all else, when all atoms are there: the task's initial knowledge.
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
  // What init says of atoms in Kf. The table has, besides, what is unknown of LCW.
  std::map<std::string, Knowledge> told_;
};

}  // namespace assay::contingent
