#include "planner/domain/workcell/uncertainty_operations.h"

#include <algorithm>

namespace assay::domain {

const std::vector<std::string>& MeasuredQuantityNames() {
  static const std::vector<std::string> names = {"gripper-opening", "tool-height"};
  return names;
}

const std::vector<std::string>& RecoveryStrategyNames() {
  static const std::vector<std::string> names = {"groping-search", "retry", "call-operator"};
  return names;
}

const std::vector<std::string>& ResolverNames() {
  static const std::vector<std::string> names = {"sensing", "squeezing", "fine-motion"};
  return names;
}

const SensorModel* UncertaintyOperations::FindSensor(std::string_view name) const {
  const auto found = std::ranges::find(sensors, name, &SensorModel::name);
  return found == sensors.end() ? nullptr : &*found;
}

}  // namespace assay::domain
