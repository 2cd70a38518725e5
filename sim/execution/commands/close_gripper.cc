#include <algorithm>
#include <cmath>

#include "sim/execution/commands/run.h"

namespace assay::execution {
namespace {

constexpr double kClosingSpeed = 0.02;  // m/s of one pad
// Speed of one pad in m/s, near the width at which it should meet the part.
constexpr double kTouchSpeed = 0.005;
// Metres of opening before the expected width, where the touch speed begins.
constexpr double kTouchMargin = 0.003;
constexpr double kClosingSettle = 0.05;  // seconds for the arm to settle before closing

// Closes until the gripper has been still for a while under its full force.
Progress CloseUntilStill(double expected_width, Execution& execution) {
  const scene::Scene& scene = execution.scene();
  mujoco::Data& data = execution.data();
  const double near = expected_width + kTouchMargin;
  if (scene.Opening(data) > near) {
    if (Progress failure = execution.MoveFingers(near, 2 * kClosingSpeed)) return failure;
  }
  double still_since = data.time();
  const auto are_still = [&] {
    if (std::abs(scene.OpeningSpeed(data)) > kFingersStill) still_since = data.time();
    return data.time() >= still_since + kFingersStillFor;
  };
  if (Progress failure = execution.MoveFingers(0, 2 * kTouchSpeed, are_still)) return failure;
  scene.CommandGripper(data, 0);
  return execution.Stay(kFingersStillFor);
}

}  // namespace

Progress Run(const CloseGripper& close, std::span<const Command>, Execution& execution) {
  const scene::Scene& scene = execution.scene();
  mujoco::Data& data = execution.data();
  if (Progress failure = execution.Stay(kClosingSettle)) return failure;
  execution.Brace();
  if (close.is_squeeze) scene.StiffenPads(data, close.part);
  if (Progress failure = CloseUntilStill(close.hold.width, execution)) return failure;
  execution.Relax();
  const GraspFact fact = {.time = data.time(),
                          .part = close.part,
                          .expected_width = close.hold.width,
                          .opening = scene.Opening(data),
                          .pads_touch = scene.Touching(data, close.part, scene.left_finger()) &&
                                        scene.Touching(data, close.part, scene.right_finger())};
  execution.trace().events.push_back(fact);
  if (fact.pads_touch) scene.AttachPart(data, close.part);
  execution.world().Take(close.part, close.hold);
  return std::nullopt;
}

}  // namespace assay::execution
