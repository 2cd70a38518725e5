#include "planner/motion/handling/grasp_choice.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace assay::motion {
namespace {

using domain::Grasp;
using domain::GraspId;
using geometry::Pose;

// Returns the vertical component of the tool's z axis. It is -1 if the tool grasps the part from
// straight above. The part then stays as upright as the tool.
double LeanOf(const Grasp& grasp, const Pose& X_WorldPart) {
  return (X_WorldPart * grasp.X_PartTool).linear()(2, 2);
}

std::vector<GraspId> MostUprightFirst(const domain::Part& part, const Pose& X_WorldPart) {
  std::vector<GraspId> grasps;
  for (std::size_t i = 0; i < part.grasps->size(); ++i) grasps.emplace_back(i);
  const auto lean = [&](GraspId id) {
    constexpr double kAlike = 1e-6;  // so that rounding does not decide the order
    return std::round(LeanOf((*part.grasps)[id.index()], X_WorldPart) / kAlike);
  };
  std::ranges::stable_sort(grasps, {}, lean);
  return grasps;
}

}  // namespace

std::optional<plan::Hold> MostUprightHold(const domain::Problem& problem, domain::PartId id,
                                          const Pose& X_WorldPart,
                                          std::span<const domain::PlacedPart> others) {
  const domain::Part& part = problem.part(id);
  const double open = problem.workcell->gripper().max_opening();
  for (const GraspId grasp : MostUprightFirst(part, X_WorldPart)) {
    const Grasp& g = (*part.grasps)[grasp.index()];
    if (!Obstacle(problem, X_WorldPart * g.X_PartTool, open, others).IsNone()) continue;
    if (!IsReachableAt(problem, id, grasp, X_WorldPart)) continue;
    return plan::Hold{.grasp = g.label, .X_PartTool = g.X_PartTool, .width = g.width};
  }
  return std::nullopt;
}

}  // namespace assay::motion
