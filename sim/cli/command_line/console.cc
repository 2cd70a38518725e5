#include "sim/cli/command_line/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/quotation.h"

namespace assay::cli {
namespace {

[[noreturn]] void FailToPrint(int error) {
  throw EnvironmentError(fmt::format(
      "standard output cannot be written: {}; the text is lost, but files that the command writes "
      "are kept: give it another output, or read these files",
      std::generic_category().message(error)));
}

}  // namespace

void PrepareStreams() {
  std::signal(SIGPIPE, SIG_IGN);
  // A file that may not grow further makes the write fail, in the same way as a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // The least free number is the stream's own, because all streams before it exist. It is opened
    // for reading, so that writing fails as it would for a closed stream.
    const int opened = open("/dev/null", O_RDONLY);
    if (opened > STDERR_FILENO) close(opened);
  }
}

void Print(std::string_view text) {
  const std::string shown = ShowLines(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size()) FailToPrint(errno);
}

void FlushOutput() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) FailToPrint(errno);
}

void PrintAndWrite(std::string_view text, const std::function<void()>& write) {
  std::exception_ptr not_printed;
  try {
    Print(text);
    FlushOutput();
  } catch (const EnvironmentError&) {
    not_printed = std::current_exception();
  }
  write();
  if (not_printed) std::rethrow_exception(not_printed);
}

void PrintError(std::string_view message) {
  std::string line(message);
  std::ranges::replace(line, '\n', ' ');
  Remark(fmt::format("assay: {}\n", Show(line, 2 * kMessageCharacters)));
}

void Remark(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

bool RemarksAreSeen() { return isatty(STDERR_FILENO) != 0; }

}  // namespace assay::cli
