#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/base/interval.h"

namespace assay::domain {

struct ActionKind;

// The ways to deal with uncertainty in a workcell: sensors, verification templates and recovery
// templates, as its file states them (Spar, "Satisfying Uncertainty-Reduction Goals" and figures 11
// and 12).

// A sensor that measures the pose of a part that lies free on the table. After the measurement each
// coordinate's error is within what the sensor promises. The whole line means that the coordinate
// is not measured.
struct SensorModel {
  std::string name;  // "overhead-camera"
  std::string description;
  Interval x, y, z, theta;  // error of the true pose against the measured one; metres, radians
};

enum class MeasuredQuantity {
  kGripperOpening,  // metres between the pads, after closing
  kToolHeight,      // metres of the tool above the table, where it met resistance
};

// A check that follows an action whose preconditions could not be proved.
struct VerificationTemplate {
  std::string name;
  const ActionKind* after = nullptr;  // the kind of action that it follows
  MeasuredQuantity quantity = MeasuredQuantity::kGripperOpening;
  double tolerance = 0;  // metres
  std::string below;     // error to signal if less than expected is measured; empty: none
  std::string above;
};

enum class RecoveryStrategy {
  kGropingSearch,  // does the action again, from places in growing circles about the first one
  kRetry,          // does the action again
  kCallOperator,
};

struct RecoveryTemplate {
  std::string error;
  RecoveryStrategy strategy = RecoveryStrategy::kCallOperator;
  double radius = 0;  // radius of a groping search, metres
  double pitch = 0;   // distance between tries of a groping search, metres
};

// The ways to meet uncertainty-reduction goals, in the order in which they are preferred (Spar,
// "Satisfying Uncertainty-Reduction Goals"; fine motion: Dakin and Popplestone).
enum class ResolverKind { kSensing, kSqueezing, kFineMotion };

// Return the enums' words in files, in the order of the enums.
const std::vector<std::string>& MeasuredQuantityNames();
const std::vector<std::string>& RecoveryStrategyNames();
const std::vector<std::string>& ResolverNames();

struct UncertaintyOperations {
  std::vector<SensorModel> sensors;
  std::vector<VerificationTemplate> verifications;
  std::vector<RecoveryTemplate> recoveries;

  const SensorModel* FindSensor(std::string_view name) const;  // null if it has none
};

}  // namespace assay::domain
