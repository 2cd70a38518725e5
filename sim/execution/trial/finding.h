#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "sim/execution/trace/trace.h"
#include "sim/execution/trial/limits.h"

namespace assay::execution {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;

// The property that a predicate is about. Each aspect has an outcome of its own.
enum class Aspect { kSeated, kAligned, kReleased, kAtRest, kLocated };

// The result of a predicate, with the numbers behind it.
struct Finding {
  Aspect aspect;
  std::string name;  // "seated depth of peg in block"
  double value = 0;
  double limit = 0;
  domain::Dimension dimension = domain::Dimension::kLength;
  bool holds = false;
};

// The predicates of a mating judge X_FixedHeld, the true pose of the held part in the fixed part's
// frame.

// Judges how far the held part is from its mated pose along the mating vector.
Finding SeatedDepth(const domain::Problem& problem, const domain::Mating& mating,
                    const Pose& X_FixedHeld);
// Judges how far the axes of the first pair of features are from where they were to meet. The value
// is the greater of the errors along the x and y axes of the fixed part's feature, because a hole
// has sides.
Finding LateralError(const domain::Problem& problem, const domain::Mating& mating,
                     const Pose& X_FixedHeld);
// Judges the angle between the held feature's axis and its direction in the mated pose.
Finding AxisAngle(const domain::Problem& problem, const domain::Mating& mating,
                  const Pose& X_FixedHeld);
// Judges how far apart the two features of a later pair are, measured across the mating vector.
// `pair` is the index of the pair, from 1 on. An example is two holes that are to lie one
// above the other.
Finding AlignmentError(const domain::Problem& problem, const domain::Mating& mating,
                       std::size_t pair, const Pose& X_FixedHeld);

// Returns all findings about a mating. It is a success if all hold.
std::vector<Finding> MatingFindings(const domain::Problem& problem, const domain::Mating& mating,
                                    const Pose& X_FixedHeld);

// The facts by which Released judges whether a part is still in the hand.
struct GripperState {
  double opening = 0;     // metres
  double held_width = 0;  // metres, when the gripper last held the part
  bool touching = false;  // the hand or the fingers touch the part
};
// Judges whether the gripper has let go of the part.
Finding Released(const domain::Part& part, const GripperState& gripper, const Limits& limits);

// Judges the part's linear and angular speed, in two findings.
std::vector<Finding> AtRest(const domain::Part& part, const execution::RestRecord::Speeds& speeds,
                            const Limits& limits);

// Judges the part against the nearest of the goal's stable poses, in two findings: the tilt from it
// and the height above it.
std::vector<Finding> Located(const domain::Part& part,
                             const std::vector<domain::StablePoseId>& stable_poses,
                             const Pose& X_WorldPart, const Limits& limits);

// Returns the finding in words: "seated depth of peg in block: 0.02 m, limit 0.001 m".
std::string Text(const Finding& finding);

}  // namespace assay::execution
