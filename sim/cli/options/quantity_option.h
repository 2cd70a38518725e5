#pragma once

#include "planner/domain/problem/units.h"

namespace CLI {
class Validator;
}  // namespace CLI

namespace assay::cli {

// Lets an option have so many of a unit as lie in a range, which is in SI; tells both in the unit.
CLI::Validator Within(const domain::Range& range, const domain::Unit& unit);

}  // namespace assay::cli
