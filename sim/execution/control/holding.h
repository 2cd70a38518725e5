#pragma once

#include <string_view>
#include <vector>

#include "planner/plan/data/strategy.h"
#include "sim/execution/robots/execution.h"

namespace assay::execution {

// The ways in which contacts can hold a part that is pushed and does not move (quasi-statically).
enum class Holding {
  kNothing,   // the contacts cannot hold the part
  kObstacle,  // a contact stands against the push, even without friction
  kJam,       // friction holds the part while it is pushed (Simunovic 1975)
  kWedge,     // the contacts squeeze the part whatever is done to it (Nevins and Whitney 1978)
};
std::string_view Name(Holding holding);  // for example "wedge"

// Returns how the contacts felt in a motion under control can hold a part that is pushed along
// `way` (unit). The places of the contacts are relative to the point that is pushed. `length` is
// plan::Strategy::length.
Holding HoldingOf(const std::vector<plan::StrategyContact>& contacts, const geometry::Vector3& way,
                  double friction, double length);

// Returns how the engine's present contacts can hold the part in the execution's hand against the
// fixed part. The part is pushed at its tip along `way` (unit, in the axes of `fixed`).
Holding TrueHolding(Execution& execution, PartId fixed, const Pose& X_HeldTip,
                    const geometry::Vector3& way, double length);

}  // namespace assay::execution
