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
using assay::bench::Series;

namespace {

constexpr const char* kUsage =
    "usage: summarize report REPORT.md PLOTS.gp FILE.json...\n"
    "       summarize contingent CONTINGENT.md FILE.json...\n"
    "Exit code 12: written, but some answers were wrong.\n";

// These are exit codes of `assay` as well.
enum ExitCode { kDone = 0, kWrongCommandLine = 2, kWrongInput = 3, kWrongAnswers = 12 };

Measurements ReadFrom(const std::vector<std::string>& arguments, std::size_t first) {
  return assay::bench::Read(
      {arguments.begin() + static_cast<std::ptrdiff_t>(first), arguments.end()});
}

// Prints the wrong answers and returns the exit code.
int ExitCodeOf(const Measurements& measurements) {
  const std::vector<const Series*> wrong = measurements.Wrong();
  for (const Series* series : wrong) fmt::print(stderr, "{}: {}\n", series->name, series->wrong);
  return wrong.empty() ? kDone : kWrongAnswers;
}

// Writes the report and the script of its plots, or the table of contingent problems, from the
// files of Google Benchmark.
int Summarize(const std::vector<std::string>& arguments) {
  if (arguments.size() >= 4 && arguments[0] == "report") {
    const Measurements measurements = ReadFrom(arguments, 3);
    std::ofstream(arguments[1]) << assay::bench::Report(measurements);
    std::ofstream(arguments[2]) << assay::bench::PlotScript(measurements);
    return ExitCodeOf(measurements);
  }
  if (arguments.size() >= 3 && arguments[0] == "contingent") {
    const Measurements measurements = ReadFrom(arguments, 2);
    std::ofstream(arguments[1]) << assay::bench::ContingentTable(measurements);
    return ExitCodeOf(measurements);
  }
  fmt::print(stderr, kUsage);
  return kWrongCommandLine;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Summarize({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kWrongInput;
  }
}
