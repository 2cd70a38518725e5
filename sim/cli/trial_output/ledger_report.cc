#include "sim/cli/trial_output/ledger_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/trial_output/json_number.h"

namespace assay::cli {
namespace {

using check::LedgerEntry;
using Json = nlohmann::ordered_json;

Unit LedgerUnit(const LedgerEntry& entry) {
  const Dimension dimension = noise::DimensionOf(entry.channel.effect);
  return dimension == Dimension::kRatio ? Unit{"-"} : ShownUnitOf(dimension);
}

std::string Number(const std::optional<double>& value, const Unit& unit) {
  if (!value) return "-";
  const double number = *value / unit.factor;
  constexpr double kHalfLastDigit = 0.00005;  // avoids the text -0.0000
  return fmt::format("{:+.4f}", std::abs(number) < kHalfLastDigit ? 0.0 : number);
}

}  // namespace

std::string Text(const std::vector<LedgerEntry>& ledger) {
  Table table({{"noise"},
               {"unit"},
               {"drawn", Align::kRight},
               {"applied", Align::kRight},
               {"measured", Align::kRight}});
  for (const LedgerEntry& entry : ledger) {
    const Unit unit = LedgerUnit(entry);
    table.Add({entry.channel.name, std::string(unit.name), Number(entry.drawn, unit),
               Number(entry.applied, unit), Number(entry.measured, unit)});
  }
  return table.Text();
}

Json ToJson(const std::vector<LedgerEntry>& ledger) {
  Json json = Json::array();
  for (const LedgerEntry& entry : ledger) {
    json.push_back({{"name", entry.channel.name},
                    {"unit", domain::SiUnitOf(noise::DimensionOf(entry.channel.effect)).name},
                    {"drawn", entry.drawn},
                    {"applied", OrNull(entry.applied)},
                    {"measured", OrNull(entry.measured)}});
  }
  return json;
}

}  // namespace assay::cli
