#include <cmath>

#include "sim/execution/commands/run.h"

namespace assay::execution {
namespace {

constexpr double kOpeningSpeed = 0.02;  // m/s of one pad; the drive follows no faster
constexpr double kSlowSpeed = 0.005;    // m/s of one pad, while it leaves the part that it held
constexpr double kSlowLength = 0.001;   // metres of opening
constexpr double kOpeningSettle = 0.1;  // seconds for the arm, and for the released part, to settle
constexpr double kOpenEnough = 0.0005;  // metres from fully open that count as open

}  // namespace

Progress Run(const OpenGripper& open, std::span<const Command>, Execution& execution) {
  const scene::Scene& scene = execution.scene();
  mujoco::Data& data = execution.data();
  const double wide = scene.max_opening();
  if (open.release) {
    if (Progress failure = execution.Stay(kOpeningSettle, Stepping::kContact)) return failure;
    scene.DetachPart(data, open.release->part);
    execution.world().LetGo(open.release->part, open.release->X_WorldPart);
  }
  double target = scene.Opening(data);
  const double slow_until = open.release ? target + kSlowLength : target;
  // If something is in the way of the fingers, opening ends where they come to rest.
  double still_since = data.time();
  while (scene.Opening(data) < wide - kOpenEnough && data.time() < still_since + kFingersStillFor) {
    const double speed = target < slow_until ? kSlowSpeed : kOpeningSpeed;
    const Stepping stepping = open.release ? Stepping::kContact : Stepping::kFree;
    target = std::min(wide, target + 2 * speed * data.timestep());
    scene.CommandGripper(data, target);
    if (Progress failure = execution.Stay(0, stepping)) return failure;
    const bool moves = std::abs(scene.OpeningSpeed(data)) > kFingersStill;
    if (moves || target < wide) still_since = data.time();
  }
  scene.CommandGripper(data, wide);
  return open.release ? execution.Stay(kOpeningSettle, Stepping::kContact) : std::nullopt;
}

}  // namespace assay::execution
