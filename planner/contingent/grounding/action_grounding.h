#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/grounding/effect_grounding.h"

namespace assay::contingent {

// The instances of actions whose precondition may hold.
class ActionGrounding {
 public:
  ActionGrounding(TermGrounding& terms, QueryGrounding& queries, EffectGrounding& effects)
      : terms_(terms), queries_(queries), effects_(effects) {}

  // Adds them to the task. Throws InputError at an action that has too many.
  void AddInstances(const Action& action);

 private:
  // A literal of the precondition that is answered as soon as its variables are bound.
  struct EarlyTest {
    const Literal* literal;
    std::size_t after;  // so many parameters are bound
  };

  void CollectEarlyTests(const Action& action, const Query& query, std::vector<EarlyTest>& tests);
  // Throws InputError if there are too many that pass the tests: each of them takes memory.
  void RequireFew(const Action& action, const std::vector<EarlyTest>& tests);
  // Calls `use` with each way to bind the parameters, from these on, that passes the tests.
  void BindFrom(const Action& action, const std::vector<EarlyTest>& tests, Bindings& bindings,
                const std::function<void()>& use);
  std::vector<GroundValue> CandidatesFor(const Action& action, const TypedName& parameter,
                                         const Bindings& bindings);
  void AddRunTimeValues(const Query& query, const std::string& parameter, const Bindings& bindings,
                        std::vector<GroundValue>& candidates);
  void AddInstance(const Action& action, const Bindings& bindings);
  // Throws InputError if what always happens gives a function two values, in all instances.
  // `first`: the action's first one.
  void RequireSingleValues(const Action& action, std::size_t first) const;
  struct TwoValues {
    Place place;
    FunctionId function;
  };
  // Of what always happens; none if there are none.
  std::optional<TwoValues> TwoValuesOf(const Action& action, const GroundAction& instance) const;

  TermGrounding& terms_;
  QueryGrounding& queries_;
  EffectGrounding& effects_;
};

}  // namespace assay::contingent
