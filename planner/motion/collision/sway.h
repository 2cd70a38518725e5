#pragma once

#include "planner/domain/workcell/workcell.h"
#include "planner/motion/paths/joint_path.h"
#include "planner/plan/data/tool_error_box.h"

namespace assay::motion {

// The effect of errors of the tool's pose on an arm that follows straight lines of the tool.
struct Sway {
  // True if the arm surely follows in the planned configuration and is never singular. If false,
  // the other members have no meaning.
  bool is_bounded = false;
  // Greatest difference of each joint from its planned value at the same point of the way, radians.
  kinematics::JointVector turn = kinematics::JointVector::Zero();
  // The least distance of any joint from the ends of its range, radians; negative if a joint may be
  // beyond them.
  double room = 0;
};

// Bounds the effect of the errors `doubt` of the tool all along `path`. The path consists of
// planned postures along straight lines of the tool. The tool keeps its orientation from each
// posture to the next.
//
// The possible poses of the tool are covered by cells. A cell is a piece of a line together with
// intervals of the errors. In the middle of a cell the inverse kinematics gives the posture q0. As
// the tool goes from there to another pose of the cell, the joints turn at rates x with J(q) x = b,
// and |b| is at most half the cell. With A = J(q0)^-1 that is x = A b + (I - A J(q)) x, so |x| <=
// |A| |b| + M |x|. M bounds |I - A J(q)|. The bound consists of the derivatives of J at q0, and of
// a bound on the higher terms that follows from how far axes and levers may turn.
//
// Let r satisfy r >= |A| |b| + M r, with M for joints within r of q0. Then no joint turns farther
// than r, and J(q) is never singular. This is the argument of Krawczyk's test (Moore, "Methods and
// Applications of Interval Analysis", 1979, 5.4) for a way instead of a root. Cells without a known
// r are halved. If b contains only the errors, (I - M)^-1 |A| |b| bounds the joints' differences
// from their planned values.
Sway SwayAlong(const domain::Workcell& workcell, const JointPath& path,
               const plan::ToolErrorBox& doubt);

}  // namespace assay::motion
