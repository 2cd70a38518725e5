#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/part/feature.h"
#include "planner/domain/part/stable_pose.h"
#include "planner/geometry/pose.h"
#include "planner/kinematics/gripper.h"

namespace assay::domain {

using GraspId = Id<struct GraspTag>;

// What pads need of the faces that they touch, where that is the least to what these have: how far
// the pads reach in one direction, and how far the faces do. Metres; both 0 where the pads fit.
struct PadRoom {
  double needed = 0;
  double available = 0;

  bool fits() const { return needed <= available; }
};

// One way to hold a part between the pads, standing for its class: all grasps of the same pair of
// faces and approach direction that hide the same features (Spar, "Reachability of Grasps").
struct Grasp {
  std::string label;                  // "PG12": part initial, G, number from 1
  geometry::Pose X_PartTool;          // z: approach, y: closing direction
  double width = 0;                   // metres between the pads when closed on the part
  std::vector<FeatureNumber> hidden;  // features that the pads touch or cover, increasing
  PadRoom room = {};
};

struct GraspSearch {
  double approach_step = 0;  // radians between approach directions in the plane of the faces
  double widest = 0;         // the widest grasp to look for, metres
  // Whether grasps are looked for as well with which the pads stick out of the faces, where there
  // are none in which they do not (Grasp::room): what a missing grasp lacks.
  bool with_misfits = false;
};

class PartModel;

// The grasps of a part by a gripper: pairs of parallel faces not wider than `widest`, approach
// directions quantized from a part axis, pads wholly on the faces and not on walls of holes, hand
// and fingers clear of the part when open, on the way in, and closed (of grasps wider than the
// gripper opens, only the hand). In each class the grasp whose pads lie deepest in the faces (up to
// 4 mm) and then nearest to the centre of mass. In order of face pairs, then of directions.
std::vector<Grasp> ComputeGrasps(const PartModel& part, const kinematics::Gripper& gripper,
                                 const GraspSearch& search);

}  // namespace assay::domain
