#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// The route of the tool in a step, as poses X_WorldTool. The arm travels between the routes of two
// steps.
struct ToolRoute {
  Pose poised = Pose::Identity();  // pose before or above the work
  std::vector<Pose> to_work = {};  // ends of straight lines, up to where it works
  std::vector<Pose> away = {};     // ends of straight lines after the work, up to where it is free

  // Returns the pose from which the arm may travel on.
  const Pose& left() const { return away.empty() ? poised : away.back(); }
};

// Returns the route of a step. X_WorldPart is the pose of the part whose place the action states
// (PlacedPart). An action that puts a part down (domain::Leaves::kAtPlace) leads to Action::place
// instead, and does not use X_WorldPart.
//
// The last line to a part and the first line away from it go along the tool's axis. Each of them
// has the length of the workcell's approach distance. A held part is lifted straight up and put
// down straight down, on lines of the same length. It is mated along the mating vector.
ToolRoute RouteOf(const domain::Problem& problem, const PlannedStep& step, const Pose& X_WorldPart);

// Returns the route of an action. `strategy` executes a mating. If it is null, the mating is a
// straight motion.
ToolRoute RouteOf(const domain::Problem& problem, const Action& action, const Strategy* strategy,
                  const Pose& X_WorldPart);

// Returns where a route begins and ends: the pose of the tool while the arm is at home.
Pose HomeTool(const domain::Workcell& workcell);
// Returns the corner of a route that is a pose drawn back along the tool's axis by the workcell's
// approach distance.
Pose Retreated(const domain::Workcell& workcell, const Pose& X_WorldTool);
// Returns the corner of a route straight above a pose, at safe height, or the pose itself if it is
// higher.
Pose AtSafeHeight(const domain::Workcell& workcell, const Pose& X_WorldTool);

}  // namespace assay::plan
