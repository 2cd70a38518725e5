#include "bench/summary/markdown.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace assay::bench {
namespace {

// Keys of the context that the report shows. Google Benchmark's own load_avg mostly comes from the
// benchmark itself, and its library_build_type describes Debian's library, so both are left out.
constexpr std::pair<const char*, const char*> kWhere[] = {
    {"revision", "revision"},
    {"date", "date"},
    {"processor", "processor"},
    {"num_cpus", "processors"},
    {"mhz_per_cpu", "MHz"},
    {"load_before",
     "load before the benchmarks began (mean number of running processes over one minute)"},
    {"compiler", "compiler"},
    {"build_type", "build type"},
    {"passes", "passes"},
    {"seed", "seed of random workloads"}};

}  // namespace

std::string Time(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  static const std::vector<std::pair<double, const char*>> kUnits = {
      {1, "s"}, {1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}};
  for (const auto& [unit, name] : kUnits) {
    if (seconds >= unit) return fmt::format("{:.3g} {}", seconds / unit, name);
  }
  return fmt::format("{:.3g} ns", seconds * 1e9);
}

std::string Multiple(double ratio) {
  return ratio < 100 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.0f}", ratio);
}

std::string Row(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string Heading(const std::vector<std::string>& cells) {
  return Row(cells) + Row(std::vector<std::string>(cells.size(), "---"));
}

std::string Where(const Measurements& measurements) {
  std::string out = "## Where\n\n";
  for (const auto& [key, meaning] : kWhere) {
    const auto at = measurements.context.find(key);
    if (at != measurements.context.end()) out += fmt::format("- {}: {}\n", meaning, at->second);
  }
  return out;
}

}  // namespace assay::bench
