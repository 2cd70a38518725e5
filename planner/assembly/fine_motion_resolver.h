#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/constraint_posting/resolvers/resolver.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/error_sets/tip_error.h"

namespace assay::assembly {

// Proposes fine motion for an assemble action whose shaft may miss its hole. A strategy is a
// sequence of contacts that is certain in spite of the possible errors (Dakin and Popplestone). The
// size of the errors is computed from all earlier actions of the plan. If the errors are too great,
// looks at the two parts are proposed with the strategy.
class FineMotionResolver : public constraint_posting::Resolver {
 public:
  explicit FineMotionResolver(uncertainty::Propagation propagation) : propagation_(propagation) {}

  std::string_view name() const override { return "fine-motion"; }
  std::vector<plan::Condition> absorbs() const override { return plan::AbsorbedByFineMotion(); }
  // Returns remedies only if all unmet goals of the step concern a shaft and its hole.
  std::vector<constraint_posting::Remedy> Propose(
      const constraint_posting::UnmetGoals& unmet) override;

  int searches() const { return static_cast<int>(plans_.size()); }  // the number of searches so far

 private:
  std::optional<plan::Strategy> StrategyFor(const constraint_posting::UnmetGoals& unmet);
  // Returns the plan for a mating and its errors. Equal errors give the same plan without a new
  // search.
  const finemotion::FineMotionPlan& PlanFor(domain::MatingId mating,
                                            const finemotion::MatingGeometry& geometry,
                                            const finemotion::FineMotionErrors& errors,
                                            double friction);

  uncertainty::Propagation propagation_;
  std::map<std::string, finemotion::FineMotionPlan> plans_;
};

// Returns the box of errors of the tip in the step. `way` describes the path of the tip: the path
// of a strategy, or the default path with which the search for a strategy begins.
uncertainty::TipBox TipBoxAt(const constraint_posting::UnmetGoals& unmet,
                             uncertainty::Propagation propagation, const uncertainty::TipWay& way);

}  // namespace assay::assembly
