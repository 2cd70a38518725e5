#include <cmath>

#include "sim/execution/commands/run.h"

namespace assay::execution {
namespace {

constexpr double kOpeningSpeed = 0.02;  // m/s of one pad; the drive follows no faster
constexpr double kSlowSpeed = 0.005;    // m/s of one pad, while it leaves the part that it held
constexpr double kSlowLength = 0.001;   // metres of opening
constexpr double kOpeningSettle = 0.1;  // seconds for the arm, and for the released part, to settle
constexpr double kOpenEnough = 0.0005;  // metres from fully open that count as open

// If something is in the way of the fingers, opening ends where they come to rest.
Progress StayUntilOpen(Execution& execution) {
  const scene::Scene& scene = execution.scene();
  mujoco::Data& data = execution.data();
  const double open_enough = scene.max_opening() - kOpenEnough;
  scene.CommandGripper(data, scene.max_opening());
  double still_since = data.time();
  while (scene.Opening(data) < open_enough && data.time() < still_since + kFingersStillFor) {
    if (Progress failure = execution.Stay(0)) return failure;
    if (std::abs(scene.OpeningSpeed(data)) > kFingersStill) still_since = data.time();
  }
  return std::nullopt;
}

}  // namespace

Progress Run(const OpenGripper& open, std::span<const Command>, Execution& execution) {
  const scene::Scene& scene = execution.scene();
  mujoco::Data& data = execution.data();
  const double wide = scene.max_opening();
  if (open.release) {
    if (Progress failure = execution.Stay(kOpeningSettle)) return failure;
    scene.DetachPart(data, open.release->part);
    execution.world().LetGo(open.release->part, open.release->X_WorldPart);
    const double slow_until = std::min(wide, scene.Opening(data) + kSlowLength);
    if (Progress failure = execution.MoveFingers(slow_until, 2 * kSlowSpeed)) return failure;
  }
  if (Progress failure = execution.MoveFingers(wide, 2 * kOpeningSpeed)) return failure;
  if (Progress failure = StayUntilOpen(execution)) return failure;
  scene.SoftenPads(data);
  return open.release ? execution.Stay(kOpeningSettle) : std::nullopt;
}

}  // namespace assay::execution
