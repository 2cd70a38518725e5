#include <fmt/core.h>

#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "bench/summary/contingent_table.h"
#include "bench/summary/measurements.h"
#include "bench/summary/plots.h"
#include "bench/summary/report.h"

using assay::bench::Measurements;

namespace {

constexpr const char* kUsage =
    "usage: summarize report REPORT.md PLOTS.gp FILE.json...\n"
    "       summarize contingent CONTINGENT.md FILE.json...\n";

Measurements ReadFrom(const std::vector<std::string>& arguments, std::size_t first) {
  return assay::bench::Read(
      {arguments.begin() + static_cast<std::ptrdiff_t>(first), arguments.end()});
}

// The report and its plots' script, or the table of contingent problems, from what Google Benchmark
// wrote. False if that is not asked for.
bool Summarize(const std::vector<std::string>& arguments) {
  if (arguments.size() >= 4 && arguments[0] == "report") {
    const Measurements measurements = ReadFrom(arguments, 3);
    std::ofstream(arguments[1]) << assay::bench::Report(measurements);
    std::ofstream(arguments[2]) << assay::bench::PlotScript(measurements);
    return true;
  }
  if (arguments.size() >= 3 && arguments[0] == "contingent") {
    std::ofstream(arguments[1]) << assay::bench::ContingentTable(ReadFrom(arguments, 2));
    return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (Summarize({argv + 1, argv + argc})) return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
  fmt::print(stderr, kUsage);
  return 2;
}
