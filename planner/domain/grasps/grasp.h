#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/grasps/pad_room.h"
#include "planner/domain/parts/feature.h"
#include "planner/domain/resting/stable_pose.h"
#include "planner/geometry/coordinates.h"
#include "planner/kinematics/grippers/gripper.h"

namespace assay::domain {

using GraspId = Id<struct GraspTag>;

// One way to hold a part between the pads. It represents its class: all grasps of the same pair of
// faces and approach direction that hide the same features (Spar, "Reachability of Grasps").
struct Grasp {
  std::string label;                  // "PG12": part initial, G, number from 1
  geometry::Pose X_PartTool;          // z is the approach vector, y the closing direction
  double width = 0;                   // metres between the pads when closed on the part
  std::vector<FeatureNumber> hidden;  // features that the pads touch or cover, increasing
  PadRoom room = {};
};

struct GraspSearch {
  double approach_step = 0;  // radians between approach directions in the plane of the faces
  double widest = 0;         // greatest width to look for, metres
  // True to search, in classes without a grasp, for grasps whose pads have too little room on the
  // faces (Grasp::room). Such a grasp shows how much room is missing.
  bool with_misfits = false;
};

class PartModel;

// Returns the grasps of a part by a gripper. They are at pairs of parallel faces not wider than
// `widest`, with approach directions quantized from a part axis, and not on walls of holes. Hand
// and fingers are clear of the part when open, on the straight approach, and when closed. For
// grasps wider than the gripper opens, only the hand must be clear.
//
// The pads lie wholly on the faces. Each class gives the grasp whose pads lie deepest in the faces
// (up to 4 mm), and among equals the nearest to the centre of mass. These grasps are ordered by
// face pairs, then by directions.
//
// Directions in which faces have no room for the pads come after them. There the pads stick out,
// and each class gives the grasp that touches most. Of the faces of a round side, pairs that are
// turned by less than `approach_step` against each other count as one, and the directions are along
// the axis and across it.
//
// Last come further grasps of classes whose faces are sides of a shaft, with the hand behind the
// shaft. The pads are as far from the tip as they can be. A peg that is only a shaft can be mated
// with such a grasp.
std::vector<Grasp> ComputeGrasps(const PartModel& part, const kinematics::Gripper& gripper,
                                 const GraspSearch& search);

}  // namespace assay::domain
