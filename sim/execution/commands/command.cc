#include "sim/execution/commands/command.h"

#include <fmt/format.h>

namespace assay::execution {
namespace {

std::string PoseText(const Pose& X_WorldTool) {
  const Vector3 p = 1e3 * X_WorldTool.translation();
  const Vector3 z = X_WorldTool.linear().col(2);
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) pointing ({:.3f}, {:.3f}, {:.3f})", p.x(), p.y(),
                     p.z(), z.x(), z.y(), z.z());
}

struct CommandText {
  const domain::Problem& problem;

  std::string operator()(const MoveAtSafeHeight& move) const {
    return "move-at-safe-height to " + PoseText(move.X_WorldTool);
  }
  std::string operator()(const FollowPath& follow) const {
    return fmt::format("follow a path of {} postures to {}", follow.path.size(),
                       PoseText(follow.X_WorldTool));
  }
  std::string operator()(const MoveStraight& move) const {
    return "move-straight to " + PoseText(move.X_WorldTool);
  }
  std::string operator()(const OpenGripper& open) const {
    if (!open.release) return "open";
    return fmt::format("open, releasing {}", problem.part(open.release->part).name);
  }
  std::string operator()(const CloseGripper& close) const {
    return fmt::format("close on {} to {:.2f} mm", problem.part(close.part).name,
                       1e3 * close.hold.width);
  }
  std::string operator()(const Look& look) const {
    return fmt::format("look at {} with {}", problem.part(look.part).name, look.sensor);
  }
  std::string operator()(const Clamp& clamp) const {
    const std::string& part = problem.part(clamp.part).name;
    return clamp.force > 0 ? fmt::format("clamp {} with {:g} N", part, clamp.force)
                           : fmt::format("unclamp {}", part);
  }
  std::string operator()(const FollowStrategy& follow) const {
    return fmt::format("feel the way into {} by {} motions", problem.part(follow.fixed).name,
                       follow.strategy.motions.size());
  }
};

}  // namespace

std::string Text(const domain::Problem& problem, const Command& command) {
  return std::visit(CommandText{problem}, command);
}

}  // namespace assay::execution
