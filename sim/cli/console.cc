#include "sim/cli/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "planner/base/input_error.h"

namespace assay::cli {
namespace {

[[noreturn]] void FailToPrint(int error) {
  throw EnvironmentError(
      fmt::format("cannot write standard output: {}", std::generic_category().message(error)));
}

}  // namespace

void Print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) FailToPrint(errno);
}

void FlushOutput() {
  if (std::fflush(stdout) != 0) FailToPrint(errno);
}

void PrintError(std::string_view message) {
  std::string line(message);
  std::ranges::replace(line, '\n', ' ');
  fmt::print(stderr, "assay: {}\n", line);
}

}  // namespace assay::cli
