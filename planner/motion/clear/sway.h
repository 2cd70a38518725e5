#pragma once

#include "planner/domain/workcell/workcell.h"
#include "planner/motion/path/joint_path.h"
#include "planner/plan/data/tool_doubt.h"

namespace assay::motion {

// What errors of the tool's pose do to an arm that follows straight lines of the tool.
struct Sway {
  // Whether the arm surely follows in the configuration in which it is planned, never singular.
  // Otherwise the rest is not bounded, and means nothing.
  bool is_bounded = false;
  // How far each joint may be from where it is planned at the same point of the way, radians.
  kinematics::JointVector turn = kinematics::JointVector::Zero();
  // What joints have left to the ends of their ranges, the least of all: radians; negative if one
  // may be beyond.
  double room = 0;
};

// `path`: planned postures along lines of the tool, which keeps its orientation from each to the
// next. `doubt`: of the tool, all along.
//
// Poses that the tool may have are covered by cells: a piece of a line, and intervals of the
// errors. In the middle of a cell the closed form gives the posture q0. As the tool goes from there
// to another pose of the cell, the joints turn at rates x with J(q) x = b, |b| at most half the
// cell. With A = J(q0)^-1 that is x = A b + (I - A J(q)) x, so that |x| <= |A| |b| + M |x|, where M
// bounds |I - A J(q)|: by the derivatives of J at q0, and beyond them by how far axes and levers
// may turn. Where some r >= |A| |b| + M r is found, M for joints within r of q0, no joint turns
// farther than r, and J(q) is never singular: the argument of Krawczyk's test (Moore, "Methods and
// Applications of Interval Analysis", 1979, 5.4) for a way instead of a root. Cells where none is
// found are halved. With b for the errors alone, (I - M)^-1 |A| |b| is how far the joints are from
// where they are planned.
Sway SwayAlong(const domain::Workcell& workcell, const JointPath& path,
               const plan::ToolDoubt& doubt);

}  // namespace assay::motion
