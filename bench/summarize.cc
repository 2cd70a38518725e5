#include <fmt/core.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <vector>

#include "bench/summary/measurements.h"
#include "bench/summary/plots.h"
#include "bench/summary/report.h"

// summarize REPORT.md PLOTS.gp FILE.json...: the report and its plots' script, from what Google
// Benchmark wrote.
int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: summarize REPORT.md PLOTS.gp FILE.json...\n");
    return 2;
  }
  try {
    const assay::bench::Measurements measurements =
        assay::bench::Read(std::vector<std::filesystem::path>(argv + 3, argv + argc));
    std::ofstream(argv[1]) << assay::bench::Report(measurements);
    std::ofstream(argv[2]) << assay::bench::PlotScript(measurements);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
  return 0;
}
