#pragma once

#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// The straight ways of the tool in the actions. The arm must follow them within its joint limits
// and in one configuration (CanFollow). All vectors and poses are in the world frame, except where
// another frame is named.

// Returns the displacement of the tool when it retreats from the place where an action is done,
// opposite to its approach direction. The displacement is in the frame in which X_FrameTool is
// given. The arm must be able to go this straight way.
geometry::Vector3 Retreat(const Workcell& workcell, const geometry::Pose& X_FrameTool);

// Returns whether the arm can go the ways of a pickup: down from the safe height, in, and up again.
// A putdown goes the same ways backwards.
bool ReachesGrasp(const Workcell& workcell, const geometry::Pose& X_WorldTool);

// Returns whether the arm can go the ways of assemble with the mated tool at X_WorldTool: down to
// where the mating starts, along the mating vector, back, and up.
bool ReachesMating(const Workcell& workcell, const geometry::Pose& X_WorldTool,
                   const geometry::Vector3& vector_World);

// Returns whether the arm can bring the tool to X_WorldTool by a straight line of `approach` (world
// frame, ending there), within joint limits and without changing its configuration on the way.
bool CanApproach(const Workcell& workcell, const geometry::Pose& X_WorldTool,
                 const geometry::Vector3& approach);

}  // namespace assay::domain
