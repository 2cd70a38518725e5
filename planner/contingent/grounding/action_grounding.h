#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/grounding/effect_grounding.h"

namespace assay::contingent {

// Makes the instances of actions whose precondition may hold.
class ActionGrounding {
 public:
  ActionGrounding(TermGrounding& terms, QueryGrounding& queries, EffectGrounding& effects)
      : terms_(terms), queries_(queries), effects_(effects) {}

  // Adds the instances of the action to the task. Throws InputError at an action that has too many.
  void AddInstances(const Action& action);

 private:
  // A literal of the precondition that is tested as soon as its variables are bound.
  struct EarlyTest {
    const Literal* literal;
    std::size_t after;  // the number of bound parameters after which the test is made
  };

  void CollectEarlyTests(const Action& action, const Query& query, std::vector<EarlyTest>& tests);
  // Throws InputError if too many instances pass the tests, because each instance takes memory.
  void RequireFew(const Action& action, const std::vector<EarlyTest>& tests);
  // Calls `use` for each way to bind the parameters that extends `bindings` and passes the tests.
  void BindFrom(const Action& action, const std::vector<EarlyTest>& tests, Bindings& bindings,
                const std::function<void()>& use);
  std::vector<GroundValue> CandidatesFor(const Action& action, const TypedName& parameter,
                                         const Bindings& bindings);
  void AddRunTimeValues(const Query& query, const std::string& parameter, const Bindings& bindings,
                        std::vector<GroundValue>& candidates);
  void AddInstance(const Action& action, const Bindings& bindings);
  // Throws InputError if, in every instance, the unconditional effects give a function two values.
  // `first` is the index of the action's first instance in the task.
  void RequireSingleValues(const Action& action, std::size_t first) const;
  struct TwoValues {
    Place place;
    FunctionId function;
  };
  // Returns the function that gets two values from the unconditional effects of the instance, or
  // none.
  std::optional<TwoValues> TwoValuesOf(const Action& action, const GroundAction& instance) const;

  TermGrounding& terms_;
  QueryGrounding& queries_;
  EffectGrounding& effects_;
};

}  // namespace assay::contingent
