#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace assay::bench {

// A benchmark, with its times over several passes.
struct Series {
  std::string name;  // "family/instance/contestant" or "Name/argument"
  // Seconds of one iteration in each pass; empty if an answer was wrong.
  std::vector<double> seconds = {};
  std::map<std::string, double> counters = {};  // counters of the first pass
  std::string wrong = {};                       // what was wrong with an answer in any pass
  std::string program = {};                     // for example "strategy" for strategy_bench
  std::string label = {};                       // the benchmark's description of its kind of work

  double Median() const;  // median of the times; infinite if there are none
};

// Returns the kind of an instance: "model-b-07" is of the kind "model-b".
std::string KindOf(std::string instance);

// The measurements of several passes over several programs.
struct Measurements {
  std::map<std::string, std::string> context;  // facts about the machine and the programs
  std::vector<Series> series;                  // in the order in which they ran

  // Returns the series with a wrong answer in any pass, in the order in which they ran.
  std::vector<const Series*> Wrong() const;
};

// Reads files that Google Benchmark wrote with --benchmark_format=json, one for each program and
// pass. A benchmark that ended with an error in any pass has a wrong answer. Throws InputError if a
// file cannot be read.
Measurements Read(const std::vector<std::filesystem::path>& files);

}  // namespace assay::bench
