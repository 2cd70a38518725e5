#include "sim/cli/workcell_report.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "sim/cli/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using domain::WorkcellRules;

// A rule with the unit in which people read it.
struct Rule {
  const char* name;
  double WorkcellRules::*value;
  const char* unit;
  double scale;  // the unit in SI
};

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::array kRules = {
    Rule{"tool_lean", &WorkcellRules::tool_lean, "deg", kDegree},
    Rule{"approach_step", &WorkcellRules::approach_step, "deg", kDegree},
    Rule{"approach_distance", &WorkcellRules::approach_distance, "mm", 0.001},
    Rule{"safe_height", &WorkcellRules::safe_height, "mm", 0.001},
    Rule{"friction", &WorkcellRules::friction, "", 1},
    Rule{"pad_friction", &WorkcellRules::pad_friction, "", 1},
    Rule{"grip_force", &WorkcellRules::grip_force, "N", 1},
    Rule{"part_gap", &WorkcellRules::part_gap, "mm", 0.001},
    Rule{"contact_allowance", &WorkcellRules::contact_allowance, "mm", 0.001},
    Rule{"pad_margin", &WorkcellRules::pad_margin, "mm", 0.001},
    Rule{"guarded_travel", &WorkcellRules::guarded_travel, "mm", 0.001},
    Rule{"lateral_compliance", &WorkcellRules::lateral_compliance, "mm", 0.001},
};

}  // namespace

Report ReportOn(const domain::Workcell& workcell) {
  Report report;
  Table table({{"rule"}, {"value", Align::kRight}, {"unit"}});
  Json rules;
  for (const Rule& rule : kRules) {
    const double value = workcell.rules().*rule.value;
    table.Add({rule.name, fmt::format("{:.6g}", value / rule.scale), rule.unit});
    rules[rule.name] = value;
  }
  const double opening = workcell.gripper().max_opening();
  report.text =
      fmt::format("workcell {}: gripper opens {:.1f} mm, {} placements\n\n{}", workcell.name(),
                  1000 * opening, workcell.placements().size(), table.Text());
  report.json = std::make_shared<const Json>(Json{{"workcell", workcell.name()},
                                                  {"max_opening", opening},
                                                  {"placements", workcell.placements().size()},
                                                  {"rules", rules}});
  return report;
}

}  // namespace assay::cli
