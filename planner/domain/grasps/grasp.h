#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/parts/feature.h"
#include "planner/domain/resting/stable_pose.h"
#include "planner/geometry/coordinates.h"
#include "planner/kinematics/gripper.h"

namespace assay::domain {

using GraspId = Id<struct GraspTag>;

// The room that the pads need, and the room that is available on the faces that they touch, in the
// direction in which room is scarcest. Both are in metres, and both are 0 if the pads fit.
struct PadRoom {
  double needed = 0;
  double available = 0;

  bool fits() const { return needed <= available; }
};

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
  // True to search for grasps whose pads stick out of the faces (Grasp::room), in classes without a
  // grasp whose pads lie wholly on the faces. Such a grasp shows how much room is missing.
  bool with_misfits = false;
};

class PartModel;

// Returns the grasps of a part by a gripper. They are at pairs of parallel faces not wider than
// `widest`, with approach directions quantized from a part axis, and with pads wholly on the faces
// and not on walls of holes. Hand and fingers are clear of the part when open, on the straight
// approach, and when closed. For grasps wider than the gripper opens, only the hand must be clear.
// Each class gives the grasp whose pads lie deepest in the faces (up to 4 mm), and among equals the
// nearest to the centre of mass. The grasps are ordered by face pairs, then by directions.
std::vector<Grasp> ComputeGrasps(const PartModel& part, const kinematics::Gripper& gripper,
                                 const GraspSearch& search);

}  // namespace assay::domain
