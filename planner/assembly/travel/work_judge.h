#pragma once

#include <span>
#include <utility>
#include <vector>

#include "planner/constraint_posting/objection.h"
#include "planner/domain/problem/problem.h"

namespace assay::assembly {

// Objects to an action if no posture of the arm can follow the straight lines of its work without
// touching itself, a table or another robot. The parts that lie about are left out, so the
// objection does not depend on them. Another grasp, or another place of the part, may help.
class WorkJudge {
 public:
  // The problem must outlive the judge.
  explicit WorkJudge(const domain::Problem& problem) : problem_(problem) {}

  // Judges the last action as described at Judge (objection.h).
  constraint_posting::Judgement operator()(std::span<const plan::Action> actions);

 private:
  bool CanWork(const plan::Action& action);

  const domain::Problem& problem_;
  std::vector<std::pair<plan::Action, bool>> known_;
};

}  // namespace assay::assembly
