#include "sim/cli/ledger_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/cli/json_number.h"
#include "sim/cli/quantity.h"
#include "sim/cli/table.h"

namespace assay::cli {
namespace {

using check::LedgerEntry;
using Json = nlohmann::ordered_json;

Unit LedgerUnit(const LedgerEntry& entry) {
  return entry.unit.empty() ? Unit{"-", 1} : UnitOf(entry.channel.name);
}

std::string Number(const std::optional<double>& value, double scale) {
  if (!value) return "-";
  const double number = scale * *value;
  constexpr double kHalfLastDigit = 0.00005;  // else there would be a -0.0000
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
    table.Add({entry.channel.name, unit.name, Number(entry.drawn, unit.scale),
               Number(entry.applied, unit.scale), Number(entry.measured, unit.scale)});
  }
  return table.Text();
}

Json ToJson(const std::vector<LedgerEntry>& ledger) {
  Json json = Json::array();
  for (const LedgerEntry& entry : ledger) {
    json.push_back({{"name", entry.channel.name},
                    {"unit", entry.unit},
                    {"drawn", entry.drawn},
                    {"applied", OrNull(entry.applied)},
                    {"measured", OrNull(entry.measured)}});
  }
  return json;
}

}  // namespace assay::cli
