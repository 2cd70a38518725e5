#include "sim/sweep/runner/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

namespace assay::sweep {
namespace {

// Returns the value of the first line "key: value"; empty if there is no such line.
std::string ValueIn(const char* file, const std::string& key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto at = line.find(separator);
    if (!line.starts_with(key) || at == std::string::npos) continue;
    const auto begin = line.find_first_not_of(" \"", at + 1);
    const auto end = line.find_last_not_of(" \"");
    return begin == std::string::npos ? "" : line.substr(begin, end - begin + 1);
  }
  return "";
}

std::string OperatingSystem() {
  utsname names{};
  uname(&names);
  const std::string pretty = ValueIn("/etc/os-release", "PRETTY_NAME", '=');
  return fmt::format("{} ({} {})", pretty.empty() ? "unknown" : pretty, names.sysname,
                     names.release);
}

}  // namespace

RunRecord ThisRun(const std::string& version, const std::string& shard, int jobs) {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now)),
          .shard = shard,
          .jobs = jobs,
          .version = version,
          .machine = ValueIn("/proc/cpuinfo", "model name", ':'),
          .cores = static_cast<int>(std::thread::hardware_concurrency()),
          .os = OperatingSystem()};
}

}  // namespace assay::sweep
