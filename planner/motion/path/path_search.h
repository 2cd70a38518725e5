#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "planner/motion/clear/motion_check.h"
#include "planner/motion/path/shortening.h"

namespace assay::motion {

struct PathRequest {
  JointVector from = JointVector::Zero();
  JointVector to = JointVector::Zero();
  MotionRules rules = {};
  std::uint64_t seed = 1;
  std::int64_t budget = 200'000;  // postures to look at in the search
  ShorteningEffort shortening = {};
};

// Why there is no path, and what was in the way.
struct PathFailure {
  enum class Reason {
    kStart,   // the rules are broken at the start; nothing was searched
    kGoal,    // the same at the goal
    kBudget,  // none found within the budget; `obstruction` ended the most motions tried
    // The same, of a part of the budget: what is kept upright would have to come into another
    // configuration of the arm. That is next to never possible.
    kConfiguration,
  };
  Reason reason = Reason::kBudget;
  Obstruction obstruction;
  std::string what;  // a sentence for people
};

using PathResult = std::variant<JointPath, PathFailure>;

// A path that keeps to the rules all along (MotionCheck): the straight one if it is free, else
// RRT-Connect's (Kuffner and LaValle 2000; OMPL), shortened. What is to be kept upright is sampled
// exactly upright. Where the tool's axis is what points up, such postures of one configuration of
// the arm form planes in joint space (q4 is 0 or half a turn, and q2 + q3 +- q5 is constant), so
// that motions between them stay upright. From one configuration to another they seldom are joined:
// such requests get a twentieth of the budget. The same request gives the same path.
PathResult FindPath(const CollisionScene& scene, const PathRequest& request);

}  // namespace assay::motion
