#pragma once

#include <string_view>
#include <vector>

#include "planner/plan/data/strategy.h"
#include "sim/exec/execution/execution.h"

namespace assay::exec {

// What contacts that touch can do to a part that is pushed and does not move (quasi-statically).
enum class Holding {
  kNothing,   // they cannot hold it
  kObstacle,  // one of them stands against the push, without any friction
  kJam,       // their friction holds it, as long as it is pushed (Simunovic 1975)
  kWedge,     // they squeeze it between them, whatever is done to it (Nevins and Whitney 1978)
};
std::string_view Name(Holding holding);  // "wedge"

// `contacts`: normals and places about the point that is pushed along `way` (unit). `length` as
// plan::Strategy::length.
Holding HoldingOf(const std::vector<plan::StrategyContact>& contacts, const geometry::Vector3& way,
                  double friction, double length);

// The same of the engine's present contacts between the part in the execution's hand and another
// one, which is pushed at its tip along `way` (in the axes of `fixed`).
Holding TrueHolding(Execution& execution, PartId fixed, const Pose& X_HeldTip,
                    const geometry::Vector3& way, double length);

}  // namespace assay::exec
