#include <csignal>

#include "sim/cli/command_line.h"

int main(int argc, char** argv) {
  // A file that may not grow further is an error of the write, told like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(assay::cli::RunCommandLine({argv, argv + argc}));
}
