#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "sim/check/trial/limits.h"
#include "sim/exec/execution/trace.h"

namespace assay::check {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;

// What a predicate speaks about, as far as outcomes are told apart.
enum class Aspect { kSeated, kAligned, kReleased, kAtRest, kLocated };

// A predicate with the numbers behind it.
struct Finding {
  Aspect aspect;
  std::string name;  // "seated depth of peg in block"
  double value = 0;
  double limit = 0;
  std::string unit;  // "m", "rad", "m/s", "rad/s"
  bool holds = false;
};

// The predicates of a mating judge X_FixedHeld, where the held part truly is in the frame of the
// fixed part.

// How far the held part is from its mated pose along the mating vector.
Finding SeatedDepth(const domain::Problem& problem, const domain::Mating& mating,
                    const Pose& X_FixedHeld, const Limits& limits);
// How far the axes of the first pair of features are apart where they were to meet, along the x and
// y axes of the fixed part's feature: the greater of the two, because a hole has sides.
Finding LateralError(const domain::Problem& problem, const domain::Mating& mating,
                     const Pose& X_FixedHeld, const Limits& limits);
// The angle between the held feature's axis and where it was to be.
Finding AxisAngle(const domain::Problem& problem, const domain::Mating& mating,
                  const Pose& X_FixedHeld, const Limits& limits);
// How far the features of a pair after the first, numbered `pair`, are apart across the mating
// vector: holes that are to lie one above the other.
Finding AlignmentError(const domain::Problem& problem, const domain::Mating& mating,
                       std::size_t pair, const Pose& X_FixedHeld, const Limits& limits);

// What is known about whether a part is still in the hand.
struct GripperState {
  double opening = 0;     // metres
  double held_width = 0;  // metres, when it held the part last
  bool touching = false;  // hand or fingers touch the part
};
Finding Released(const domain::Part& part, const GripperState& gripper, const Limits& limits);

// Two findings: linear and angular speed.
std::vector<Finding> AtRest(const domain::Part& part, const exec::RestRecord::Speeds& speeds,
                            const Limits& limits);

// Two findings about the nearest of the goal's stable poses: tilt from it and height.
std::vector<Finding> Located(const domain::Part& part,
                             const std::vector<domain::StablePoseId>& stable_poses,
                             const Pose& X_WorldPart, const Limits& limits);

}  // namespace assay::check
