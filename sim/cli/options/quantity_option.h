#pragma once

#include "planner/domain/units/units.h"

namespace CLI {
class Validator;
}  // namespace CLI

namespace assay::cli {

// Returns a validator for an option whose value is in `unit`. `range` is in SI units; error
// messages state value and range in `unit`.
CLI::Validator Within(const domain::Range& range, const domain::Unit& unit);

}  // namespace assay::cli
