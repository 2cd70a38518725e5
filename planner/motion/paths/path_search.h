#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "planner/motion/collision/motion_check.h"
#include "planner/motion/paths/shortening.h"

namespace assay::motion {

struct PathRequest {
  JointVector from = JointVector::Zero();
  JointVector to = JointVector::Zero();
  MotionRules rules = {};
  std::uint64_t seed = 1;
  std::int64_t budget = 200'000;  // greatest number of postures that the search tests
  ShorteningEffort shortening = {};
};

// The reason why there is no path, and what was in the way.
struct PathFailure {
  enum class Reason {
    kStart,   // the rules are broken at the start; nothing was searched
    kGoal,    // the rules are broken at the goal; nothing was searched
    kBudget,  // none found within the budget; `obstruction` ended the most motions tried
    // No path was found within a part of the budget. The arm would have to change its configuration
    // while it keeps an object upright, which is almost never possible.
    kConfiguration,
  };
  Reason reason = Reason::kBudget;
  Obstruction obstruction;
  std::string what;           // a sentence for people
  std::int64_t postures = 0;  // that were tested
};

using PathResult = std::variant<JointPath, PathFailure>;

// Returns a path that obeys the rules all along (MotionCheck): the straight one if it is free, and
// otherwise one found by RRT-Connect (Kuffner and LaValle 2000; OMPL) and shortened. The same
// request gives the same path.
//
// Objects that are to be kept upright are sampled exactly upright. If the tool's axis is the
// direction that points up, the upright postures of one configuration of the arm form planes in
// joint space: q4 is 0 or half a turn, and q2 + q3 +- q5 is constant. Motions within such a plane
// stay upright. A path between upright postures of two configurations seldom exists, so the search
// for such a path gets only a twentieth of the budget.
PathResult FindPath(const CollisionScene& scene, const PathRequest& request);

}  // namespace assay::motion
