#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace assay::bench {

// A benchmark, with its times over several passes.
struct Series {
  std::string name;                             // "family/instance/contestant", "Name/argument"
  std::vector<double> seconds = {};             // of an iteration, one of each pass; see `wrong`
  std::map<std::string, double> counters = {};  // of the first pass
  std::string wrong = {};    // what was, of an answer in any pass: there are no times then
  std::string program = {};  // "strategy", of strategy_bench
  std::string label = {};    // what the benchmark says of its kind of work

  double Median() const;  // of the times; infinite if there are none
};

// "model-b-07" is of the kind "model-b".
std::string KindOf(std::string instance);

// What several passes over several programs measured.
struct Measurements {
  std::map<std::string, std::string> context;  // of the machine, and what programs tell
  std::vector<Series> series;                  // in the order in which they ran

  // Whose answer was wrong in any pass, in that order.
  std::vector<const Series*> Wrong() const;
};

// From files that Google Benchmark wrote with --benchmark_format=json, one for each program and
// pass. Who ended with an error in any pass answered wrong. Throws InputError if a file cannot be
// read.
Measurements Read(const std::vector<std::filesystem::path>& files);

}  // namespace assay::bench
