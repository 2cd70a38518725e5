#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/constraint_posting/impossibility/relaxed_problem.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/reason.h"

namespace assay::constraint_posting {

// A proof that no plan of any length exists. It consists of the hypotheses, the attainable set and
// the reasons. The attainable set holds all facts that could possibly come true
// (relaxed_problem.h), and lacks a goal. It serves to check the proof (impossibility_check.h).
// Everything else is in the scenario's words.
struct Impossibility {
  // The hypotheses of "no plan": robots, actions, grasps and places.
  std::vector<std::string> hypotheses = {};
  Attainable attainable = {};
  // The constraints that cannot hold together under the hypotheses. The list is never empty.
  // Without any one of them, the relaxed problem is possible.
  std::vector<plan::Reason> conflict = {};
  // By how little single constraints of the conflict fail, and where (near_miss.h).
  std::vector<plan::Reason> near_misses = {};
};

// The answer for a problem in which no plan was found.
struct ImpossibilityAnswer {
  std::optional<Impossibility> proof = {};
  // The limits of this planner that a plan may need to exceed, if there is no proof.
  std::vector<std::string> limits = {};
};
ImpossibilityAnswer ProveImpossible(const domain::Problem& problem);

}  // namespace assay::constraint_posting
