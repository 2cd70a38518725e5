#pragma once

#include "planner/contingent/effect_grounding.h"

namespace assay::contingent {

// What a problem's init says.
class InitialGrounding {
 public:
  InitialGrounding(const Problem& problem, TermGrounding& terms, EffectGrounding& effects)
      : problem_(problem), terms_(terms), effects_(effects) {}

  // Comes before all else: tells the table which atoms are always known.
  void Tell();
  // Comes after all else, when all atoms are there: the task's initial knowledge.
  void Ground();

 private:
  void TellUnknown(const Change& change);
  void TellFact(const Change& change);
  void Ground(const Change& change);
  void AddRelation(const GroundChange& change, Place place);
  void GroundRanges();
  void NarrowRange(const GroundChange& change, Place place);
  Range& RangeOf(FunctionId function);

  const Problem& problem_;
  TermGrounding& terms_;
  EffectGrounding& effects_;
};

}  // namespace assay::contingent
