#include "sim/cli/options/quantity_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "planner/base/input_files/quotation.h"

namespace assay::cli {

CLI::Validator Within(const domain::Range& range, const domain::Unit& unit) {
  const std::string allowed = InUnit(range, unit);
  const auto explain = [=](const std::string& text) {
    double number = 0;
    if (!CLI::detail::lexical_cast(text, number) || std::isnan(number)) {
      return fmt::format("{} is no number", Quote(text));
    }
    if (std::isinf(number)) return fmt::format("{} is no finite number", Quote(text));
    if (IsWithin(number * unit.factor, range)) return std::string();
    return fmt::format("{} is out of range; allowed: {}", Beside(text, unit), allowed);
  };
  return {explain, allowed, "within"};
}

}  // namespace assay::cli
