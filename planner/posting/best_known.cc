#include "planner/posting/best_known.h"

#include <cmath>
#include <string>

#include "planner/base/check.h"

namespace assay::posting {
namespace {

bool IsMeasured(const Interval& promise) {
  return std::isfinite(promise.low) && std::isfinite(promise.high);
}

bool HoldsZero(const Interval& range) { return range.low <= 0 && range.high >= 0; }
bool HoldsZero(const domain::PoseError& error) {
  return HoldsZero(error.x) && HoldsZero(error.y) && HoldsZero(error.z) && HoldsZero(error.theta);
}

}  // namespace

std::optional<domain::Problem> BestKnown(domain::Problem problem) {
  bool may_be_zero = HoldsZero(problem.gripper_error);
  bool height_is_measured = false;
  for (const std::string& name : problem.sensors) {
    const auto* sensor = problem.workcell->uncertainty_operations().FindSensor(name);
    ASSAY_CHECK(sensor != nullptr, "the workcell has no sensor '{}'", name);
    height_is_measured |= IsMeasured(sensor->z);
    may_be_zero &= HoldsZero(sensor->x) && HoldsZero(sensor->y) && HoldsZero(sensor->z) &&
                   HoldsZero(sensor->theta);
  }
  for (const domain::Part& part : problem.parts) may_be_zero &= HoldsZero(part.error);
  if (!may_be_zero) return std::nullopt;
  for (domain::Part& part : problem.parts) {
    const Interval height = part.error.z;
    part.error = {};
    if (!height_is_measured) part.error.z = height;
  }
  return problem;
}

}  // namespace assay::posting
