#include "bench/summary/measurements.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "planner/base/input_files/input_error.h"

namespace assay::bench {
namespace {

using Json = nlohmann::json;

Json Load(const std::filesystem::path& file) {
  std::ifstream stream(file);
  try {
    return Json::parse(stream);
  } catch (const Json::parse_error& error) {
    throw InputError({.file = file.string()}, error.what(), "JSON as Google Benchmark writes it");
  }
}

// Returns the processor time of a benchmark, or its own measurement if it measures its time itself.
double Seconds(const Json& entry) {
  static const std::map<std::string, double> kUnits = {
      {"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"s", 1}};
  const bool by_itself = entry.at("name").get<std::string>().ends_with("/manual_time");
  return entry.at(by_itself ? "real_time" : "cpu_time").get<double>() *
         kUnits.at(entry.at("time_unit").get<std::string>());
}

// Returns the user counters. Google Benchmark mixes them with keys of its own.
std::map<std::string, double> CountersOf(const Json& entry) {
  static const std::set<std::string> kOwn = {"family_index", "per_family_instance_index",
                                             "repetitions",  "repetition_index",
                                             "threads",      "iterations",
                                             "real_time",    "cpu_time"};
  std::map<std::string, double> counters;
  for (const auto& [key, value] : entry.items()) {
    if (value.is_number() && !kOwn.contains(key)) counters[key] = value.get<double>();
  }
  return counters;
}

// Returns the benchmark's name. Google Benchmark appends the settings of a benchmark's length to
// it.
std::string NameOf(const Json& entry) {
  const std::string name = entry.at("name");
  return name.substr(0, std::min(name.find("/iterations:"), name.find("/min_time:")));
}

std::string ProgramOf(const Json& context) {
  const std::string file =
      std::filesystem::path(context.value("executable", "")).filename().string();
  return file.substr(0, file.find("_bench"));
}

class Reader {
 public:
  void Add(const Json& file) {
    for (const auto& [key, value] : file.at("context").items()) {
      measurements_.context[key] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    const std::string program = ProgramOf(file.at("context"));
    for (const Json& entry : file.at("benchmarks")) {
      if (entry.at("run_type") == "iteration") Add(entry, SeriesOf(program, NameOf(entry)));
    }
  }
  // Returns the measurements. A series with a wrong answer has no times, since the times of its
  // other passes would be compared with times of the wrong passes.
  Measurements Take() {
    for (Series& series : measurements_.series) {
      if (!series.wrong.empty()) series.seconds.clear();
    }
    return std::move(measurements_);
  }

 private:
  Series& SeriesOf(const std::string& program, const std::string& name) {
    const auto [at, is_new] = index_.try_emplace({program, name}, measurements_.series.size());
    if (is_new) measurements_.series.push_back({.name = name, .program = program});
    return measurements_.series[at->second];
  }

  static void Add(const Json& entry, Series& series) {
    if (entry.value("error_occurred", false)) {
      series.wrong = entry.at("error_message");
      return;
    }
    if (series.seconds.empty()) {
      series.counters = CountersOf(entry);
      series.label = entry.value("label", "");
    }
    series.seconds.push_back(Seconds(entry));
  }

  Measurements measurements_;
  std::map<std::pair<std::string, std::string>, std::size_t> index_;
};

}  // namespace

double Series::Median() const {
  if (seconds.empty()) return std::numeric_limits<double>::infinity();
  std::vector<double> sorted = seconds;
  std::ranges::sort(sorted);
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

std::string KindOf(std::string instance) {
  instance.resize(instance.find_last_not_of("0123456789") + 1);
  while (instance.ends_with('-')) instance.pop_back();
  return instance;
}

std::vector<const Series*> Measurements::Wrong() const {
  std::vector<const Series*> wrong;
  for (const Series& one : series) {
    if (!one.wrong.empty()) wrong.push_back(&one);
  }
  return wrong;
}

Measurements Read(const std::vector<std::filesystem::path>& files) {
  Reader reader;
  for (const std::filesystem::path& file : files) {
    try {
      reader.Add(Load(file));
    } catch (const Json::exception& error) {
      throw InputError({.file = file.string()}, error.what(), "JSON as Google Benchmark writes it");
    }
  }
  return reader.Take();
}

}  // namespace assay::bench
