#include "sim/check/claims/unit.h"

#include "planner/base/check.h"

namespace assay::check {

std::string_view Name(Unit unit) {
  switch (unit) {
    case Unit::kNone:
      return "";
    case Unit::kMetre:
      return "m";
    case Unit::kRadian:
      return "rad";
  }
  ASSAY_CHECK(false, "a unit that the switch does not know");
  return {};
}

double AsLength(double value, Unit unit) {
  constexpr double kArm = 0.1;
  return unit == Unit::kRadian ? kArm * value : value;
}

}  // namespace assay::check
