#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/constraint_posting/impossibility/relaxed_problem.h"
#include "planner/domain/problem/problem.h"

namespace assay::constraint_posting {

// A proof that no plan of any length exists. It consists of the hypotheses, the set of facts that
// can at most come true (relaxed_problem.h) and that misses a goal, and the reasons. Everything is
// in the scenario's words, except the attainable set, which exists to be checked
// (impossibility_check.h).
struct Impossibility {
  // The hypotheses of "no plan": robots, actions, grasps and places.
  std::vector<std::string> hypotheses = {};
  Attainable attainable = {};
  // The constraints that cannot hold together under the hypotheses. The list is never empty.
  // Without any one of them, the relaxed problem is possible.
  std::vector<std::string> conflict = {};
  // The least excess by which single constraints of the conflict fail, and where.
  std::vector<std::string> near_misses = {};
};

// The answer for a problem in which no plan was found.
struct ImpossibilityAnswer {
  std::optional<Impossibility> proof = {};
  // Without a proof: limits of this planner that a plan may need to exceed, if there are any.
  std::vector<std::string> limits = {};
};
ImpossibilityAnswer ProveImpossible(const domain::Problem& problem);

}  // namespace assay::constraint_posting
