#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Where the tool goes in a step: X_WorldTool. Between the steps the arm travels.
struct ToolRoute {
  Pose poised = Pose::Identity();  // before or above its work
  std::vector<Pose> to_work = {};  // ends of straight lines, up to where it works
  std::vector<Pose> away = {};     // likewise, after it, up to where it is free of its work

  // Where the tool is when the arm may travel on.
  const Pose& left() const { return away.empty() ? poised : away.back(); }
};

// The part that an action is about; of a mating the fixed one.
PartId PartOf(const domain::Problem& problem, const Action& action);

// X_WorldPart: where that part is; of putdown it is not asked for.
//
// The last piece to a part and the first away from it are along the tool's axis, as long as the
// workcell's approach distance. A held part is lifted and put down by the same length straight up
// and down, and mated along the mating vector.
ToolRoute RouteOf(const domain::Problem& problem, const PlannedStep& step, const Pose& X_WorldPart);

// Of the actions; RouteOf(step) calls these.
ToolRoute RouteOf(const domain::Problem& problem, const Pickup& pickup, const Pose& X_WorldPart);
ToolRoute RouteOf(const domain::Problem& problem, const Putdown& putdown);
ToolRoute RouteOf(const domain::Problem& problem, const Assemble& assemble,
                  const Pose& X_WorldFixed);
ToolRoute RouteOf(const domain::Problem& problem, const Assemble& assemble,
                  const Strategy& strategy, const Pose& X_WorldFixed);
ToolRoute RouteOf(const domain::Problem& problem, const Squeeze& squeeze, const Pose& X_WorldPart);

// Where the tool is while the arm is at home.
Pose HomeTool(const domain::Workcell& workcell);
// The tool drawn back along its axis by the workcell's approach distance.
Pose Retreated(const domain::Workcell& workcell, const Pose& X_WorldTool);
// The tool straight above, at safe height or where it is if that is higher.
Pose AtSafeHeight(const domain::Workcell& workcell, const Pose& X_WorldTool);

}  // namespace assay::plan
