#include "sim/check/trial_verdicts/extreme_poses.h"

#include <array>
#include <cmath>

#include "planner/geometry/pose.h"
#include "sim/check/measurements/observed_error.h"

namespace assay::check {
namespace {

using geometry::Pose;
using geometry::Translation;
using geometry::Vector3;

// One error of an error set.
struct Error {
  double x = 0, y = 0, z = 0;            // metres
  double theta = 0, tip = 0, twist = 0;  // radians
};

struct Component {
  Interval plan::ErrorSet::*range;
  double Error::*value;
  double Sight::*sight;
};
constexpr std::array kComponents = {
    Component{&plan::ErrorSet::x, &Error::x, &Sight::length},
    Component{&plan::ErrorSet::y, &Error::y, &Sight::length},
    Component{&plan::ErrorSet::z, &Error::z, &Sight::length},
    Component{&plan::ErrorSet::theta, &Error::theta, &Sight::angle},
    Component{&plan::ErrorSet::tip, &Error::tip, &Sight::angle},
    Component{&plan::ErrorSet::twist, &Error::twist, &Sight::angle},
};

bool IsBounded(const Interval& range) {
  return std::isfinite(range.low) && std::isfinite(range.high);
}

Error MiddleOf(const plan::ErrorSet& set) {
  Error middle;
  for (const Component& component : kComponents) {
    const Interval& range = set.*component.range;
    if (IsBounded(range)) middle.*component.value = (range.low + range.high) / 2;
  }
  return middle;
}

Pose InHand(const Error& error, const plan::Action& action, const Pose& X_WorldTool) {
  const Pose X_ToolGrasp = Translation(error.x, error.y, error.z) *
                           geometry::RotationZ(error.theta) * geometry::RotationX(error.tip) *
                           geometry::RotationY(error.twist);
  return X_WorldTool * X_ToolGrasp * HoldOf(action).X_PartTool.inverse();
}

Pose Displaced(const Error& error, const Pose& believed) {
  Pose pose = believed;
  pose.pretranslate(Vector3(error.x, error.y, error.z));
  pose.linear() = geometry::RotationZ(error.theta).linear() * believed.linear();
  return pose;
}

}  // namespace

std::vector<Pose> ExtremePoses(const plan::Action& action, const plan::ErrorSet& set,
                               const execution::Snapshot& snapshot, const Sight& sight) {
  const auto pose_with = [&](const Error& error) {
    return set.in_hand ? InHand(error, action, snapshot.tool.believed)
                       : Displaced(error, snapshot.parts[set.part.index()].believed);
  };
  const Error middle = MiddleOf(set);
  std::vector<Pose> poses;
  for (const Component& component : kComponents) {
    const Interval& range = set.*component.range;
    if (!IsBounded(range) || range.high - range.low <= sight.*component.sight) continue;
    for (const double end : {range.low, range.high}) {
      Error error = middle;
      error.*component.value = end;
      poses.push_back(pose_with(error));
    }
  }
  return poses;
}

}  // namespace assay::check
