#include "planner/domain/reachability/action_ways.h"

#include <algorithm>
#include <array>
#include <span>

#include "planner/domain/parts/feature.h"
#include "planner/domain/reachability/tool_path.h"

namespace assay::domain {
namespace {

using geometry::Pose;
using geometry::Vector3;

Vector3 Raised(const Workcell& workcell, const Vector3& p_World) {
  return {p_World.x(), p_World.y(), std::max(p_World.z(), workcell.rules().safe_height)};
}

bool IsStraightAbove(const Vector3& high, const Vector3& low) {
  return high.z() >= low.z() && (high - low).head<2>().norm() < kRounding;
}

}  // namespace

Vector3 Retreat(const Workcell& workcell, const Pose& X_FrameTool) {
  return -workcell.rules().approach_distance * X_FrameTool.linear().col(2);
}

bool ReachesGrasp(const Workcell& workcell, const Pose& X_WorldTool) {
  const Vector3 grasp = X_WorldTool.translation();
  const Vector3 retreated = grasp + Retreat(workcell, X_WorldTool);
  const std::array corners = {Raised(workcell, retreated), retreated, grasp,
                              Raised(workcell, grasp)};
  // Straight above the grasp, the arm goes up along the line on which it comes down.
  const std::size_t needed = IsStraightAbove(retreated, grasp) ? 3 : 4;
  return CanFollow(workcell, X_WorldTool.linear(), std::span(corners).first(needed));
}

bool ReachesMating(const Workcell& workcell, const Pose& X_WorldTool, const Vector3& vector_World) {
  const Vector3 mated = X_WorldTool.translation();
  const Vector3 start = mated - vector_World;
  const Vector3 retreated = mated + Retreat(workcell, X_WorldTool);
  // If all ways are on one line, a single way is followed.
  if (IsStraightAbove(start, mated) && IsStraightAbove(retreated, mated)) {
    const Vector3& higher = start.z() > retreated.z() ? start : retreated;
    return CanFollow(workcell, X_WorldTool.linear(), std::array{Raised(workcell, higher), mated});
  }
  return CanFollow(
      workcell, X_WorldTool.linear(),
      std::array{Raised(workcell, start), start, mated, retreated, Raised(workcell, retreated)});
}

bool CanApproach(const Workcell& workcell, const Pose& X_WorldTool, const Vector3& approach) {
  const Vector3 end = X_WorldTool.translation();
  return CanFollow(workcell, X_WorldTool.linear(), std::array<Vector3, 2>{end - approach, end});
}

}  // namespace assay::domain
