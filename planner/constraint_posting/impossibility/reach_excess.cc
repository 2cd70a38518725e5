#include "planner/constraint_posting/impossibility/reach_excess.h"

#include "planner/domain/reachability/tool_path.h"
#include "planner/geometry/pose.h"

namespace assay::constraint_posting {
namespace {

constexpr double kStep =
    0.02;  // metres; poses between two steps are tried if the second is reached
constexpr double kFine = 0.001;  // metres

}  // namespace

std::optional<plan::Excess> ReachExcess(const domain::Workcell& workcell,
                                        const geometry::Pose& X_WorldTool) {
  geometry::Vector3 from_axis = X_WorldTool.translation() - workcell.X_WorldBase().translation();
  from_axis.z() = 0;
  const double distance = from_axis.norm();
  const auto is_reached = [&](double nearer) {
    const geometry::Vector3 shift = -nearer * from_axis / distance;
    return domain::IsReached(workcell, geometry::Translation(shift) * X_WorldTool);
  };
  double nearer = 0;
  while (nearer < distance && !is_reached(nearer)) nearer += kStep;
  if (nearer == 0 || nearer >= distance) return std::nullopt;
  while (is_reached(nearer - kFine)) nearer -= kFine;
  return plan::Excess{domain::Dimension::kLength, distance, distance - nearer};
}

}  // namespace assay::constraint_posting
