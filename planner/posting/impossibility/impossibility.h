#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/posting/impossibility/relaxed_problem.h"

namespace assay::posting {

// A proof that no plan of any length exists: what it is said of, what can at most come true
// (relaxed_problem.h), which misses a goal, and why. All of it in the scenario's words but for what
// is attainable, which is there to be checked (impossibility_check.h).
struct Impossibility {
  // What "no plan" is said of: robots, actions, grasps, places.
  std::vector<std::string> hypotheses = {};
  Attainable attainable = {};
  // Constraints that cannot hold together under the hypotheses; never empty, and without any one
  // of them the relaxed problem is possible.
  std::vector<std::string> conflict = {};
  // By how much single constraints of the conflict fail at least, and where.
  std::vector<std::string> near_misses = {};
};

// The answer for a problem in which no plan was found.
struct ImpossibilityAnswer {
  std::optional<Impossibility> proof = {};
  // Without a proof: limits of this planner that a plan may need to pass, if there are such.
  std::vector<std::string> limits = {};
};
ImpossibilityAnswer ProveImpossible(const domain::Problem& problem);

}  // namespace assay::posting
