#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/finemotion/contacts/mating.h"
#include "planner/posting/resolvers/resolver.h"
#include "planner/uncertainty/errors/tip_error.h"

namespace assay::assembly {

// Conditions of assemble that strategies absorb.
const std::vector<std::string>& AbsorbedConditions();

// Proposes to execute an assemble action whose shaft may miss its hole by fine motion: by a
// sequence of contacts that is certain in spite of the errors that there may be (Dakin and
// Popplestone). How great these are is computed from all that the plan does before; if they are too
// great, looks at the two parts are proposed with it.
class FineMotionResolver : public posting::Resolver {
 public:
  explicit FineMotionResolver(uncertainty::Propagation propagation) : propagation_(propagation) {}

  std::string_view name() const override { return "fine-motion"; }
  std::vector<std::string> absorbs() const override { return AbsorbedConditions(); }
  // Only steps are answered whose unmet goals are all of shaft and hole.
  std::vector<posting::Remedy> Propose(const posting::UnmetGoals& unmet) override;

  int searches() const { return static_cast<int>(plans_.size()); }  // so far

 private:
  std::optional<plan::Strategy> StrategyFor(const posting::UnmetGoals& unmet);
  // The same errors ask for the same plan.
  const finemotion::FineMotionPlan& PlanFor(domain::MatingId mating,
                                            const finemotion::MatingGeometry& geometry,
                                            const finemotion::FineMotionErrors& errors,
                                            double friction);

  uncertainty::Propagation propagation_;
  std::map<std::string, finemotion::FineMotionPlan> plans_;
};

// The box of errors of the tip in the step, which the strategy or a way to be had one for takes.
uncertainty::TipBox TipBoxAt(const posting::UnmetGoals& unmet, uncertainty::Propagation propagation,
                             const uncertainty::TipWay& way);

}  // namespace assay::assembly
