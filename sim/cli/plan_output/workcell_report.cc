#include "sim/cli/plan_output/workcell_report.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "planner/domain/actions/actions.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/arm_notes.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using domain::WorkcellRules;

// A rule of the workcell with the unit in which people read it.
struct Rule {
  const char* name;
  double WorkcellRules::*value;
  Unit unit;
};

std::string NameOf(domain::MeasuredQuantity quantity) {
  return domain::MeasuredQuantityNames()[static_cast<std::size_t>(quantity)];
}
std::string NameOf(domain::RecoveryStrategy strategy) {
  return domain::RecoveryStrategyNames()[static_cast<std::size_t>(strategy)];
}

constexpr std::array kRules = {
    Rule{"tool_lean", &WorkcellRules::tool_lean, kAngleUnit},
    Rule{"approach_step", &WorkcellRules::approach_step, kAngleUnit},
    Rule{"approach_distance", &WorkcellRules::approach_distance, kLengthUnit},
    Rule{"safe_height", &WorkcellRules::safe_height, kLengthUnit},
    Rule{"friction", &WorkcellRules::friction, kRatioUnit},
    Rule{"pad_friction", &WorkcellRules::pad_friction, kRatioUnit},
    Rule{"grip_force", &WorkcellRules::grip_force, domain::kNewtons},
    Rule{"part_gap", &WorkcellRules::part_gap, kLengthUnit},
    Rule{"contact_allowance", &WorkcellRules::contact_allowance, kLengthUnit},
    Rule{"pad_margin", &WorkcellRules::pad_margin, kLengthUnit},
    Rule{"guarded_travel", &WorkcellRules::guarded_travel, kLengthUnit},
    Rule{"lateral_compliance", &WorkcellRules::lateral_compliance, kLengthUnit},
};

std::string NamedOrNothing(const std::string& error) { return error.empty() ? "-" : error; }

// Returns the workcell's sensors and other means against uncertainty.
std::string OperationsText(const domain::UncertaintyOperations& operations) {
  Table sensors({{"sensor"}, {"x mm"}, {"y mm"}, {"z mm"}, {"theta deg"}, {""}});
  for (const domain::SensorModel& sensor : operations.sensors) {
    sensors.Add({sensor.name, RangeText(sensor.x, kLengthUnit), RangeText(sensor.y, kLengthUnit),
                 RangeText(sensor.z, kLengthUnit), RangeText(sensor.theta, kAngleUnit),
                 sensor.description});
  }
  Table verifications({{"verification"}, {"after"}, {"measures"}, {"+-"}, {"less"}, {"more"}});
  for (const domain::VerificationTemplate& check : operations.verifications) {
    verifications.Add({check.name, std::string(check.after->name), NameOf(check.quantity),
                       QuantityText(check.tolerance, kLengthUnit), NamedOrNothing(check.below),
                       NamedOrNothing(check.above)});
  }
  Table recoveries({{"recovery from"}, {"strategy"}, {"radius"}, {"pitch"}});
  for (const domain::RecoveryTemplate& recovery : operations.recoveries) {
    const bool searches = recovery.strategy == domain::RecoveryStrategy::kGropingSearch;
    recoveries.Add({recovery.error, NameOf(recovery.strategy),
                    searches ? QuantityText(recovery.radius, kLengthUnit) : "-",
                    searches ? QuantityText(recovery.pitch, kLengthUnit) : "-"});
  }
  std::string text;
  if (!operations.sensors.empty()) text += fmt::format("\n{}", sensors.Text());
  if (!operations.verifications.empty()) text += fmt::format("\n{}", verifications.Text());
  if (!operations.recoveries.empty()) text += fmt::format("\n{}", recoveries.Text());
  return text;
}

template <class Named>
Json ArrayOf(const std::vector<Named>& list, std::string Named::*name) {
  Json names = Json::array();
  for (const Named& item : list) names.push_back(item.*name);
  return names;
}

std::string NotesOnArms(const domain::Workcell& workcell) {
  std::string text;
  for (const domain::Robot& robot : workcell.robots()) text += ArmNotes(robot.arm->model());
  return text;
}

}  // namespace

Report ReportOn(const domain::Workcell& workcell) {
  Report report;
  Table table({{"rule"}, {"value", Align::kRight}, {"unit"}});
  Json rules;
  for (const Rule& rule : kRules) {
    const double value = workcell.rules().*rule.value;
    table.Add(
        {rule.name, fmt::format("{:.6g}", value / rule.unit.factor), std::string(rule.unit.name)});
    rules[rule.name] = value;
  }
  const domain::UncertaintyOperations& operations = workcell.uncertainty_operations();
  const double opening = workcell.gripper().max_opening();
  report.text =
      fmt::format("workcell {}: gripper opens {:.1f} mm, {} placements\n\n{}", workcell.name(),
                  1000 * opening, workcell.placements().size(), table.Text()) +
      OperationsText(operations) + NotesOnArms(workcell);
  report.json = std::make_shared<const Json>(Json{
      {"workcell", workcell.name()},
      {"max_opening", opening},
      {"placements", workcell.placements().size()},
      {"rules", rules},
      {"sensors", ArrayOf(operations.sensors, &domain::SensorModel::name)},
      {"verifications", ArrayOf(operations.verifications, &domain::VerificationTemplate::name)},
      {"recoveries", ArrayOf(operations.recoveries, &domain::RecoveryTemplate::error)}});
  return report;
}

}  // namespace assay::cli
