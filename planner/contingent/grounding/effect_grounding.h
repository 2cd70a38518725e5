#pragma once

#include <vector>

#include "planner/contingent/grounding/query_grounding.h"

namespace assay::contingent {

// Makes effects without variables from effects with variables.
class EffectGrounding {
 public:
  EffectGrounding(TermGrounding& terms, QueryGrounding& queries)
      : terms_(terms), queries_(queries) {}

  // Adds one effect for each way to bind the effect's variables. Omits those whose condition cannot
  // hold.
  void AddEffects(const Effect& effect, Bindings bindings, std::vector<GroundEffect>& to);
  std::vector<GroundChange> ChangesOf(const Change& change, const Bindings& bindings);

 private:
  std::vector<GroundChange> FactChanges(const Change& change, const Bindings& bindings);
  std::vector<GroundChange> ValueChanges(const Change& change, FunctionId id,
                                         const GroundValue& value, const Literal& literal);
  std::vector<GroundChange> NumberChanges(const Change& change, const Literal& literal,
                                          const Bindings& bindings);
  std::vector<GroundChange> WhetherChanges(const std::vector<Literal>& literals, bool is_addition,
                                           const Bindings& bindings);
  std::vector<GroundChange> RelationChanges(const Change& change, const Bindings& bindings);
  std::vector<GroundChange> ClosedChanges(const Change& change, Bindings bindings);

  TermGrounding& terms_;
  QueryGrounding& queries_;
};

}  // namespace assay::contingent
