#include "sim/cli/program/command_line.h"
#include "sim/cli/program/console.h"

int main(int argc, char** argv) {
  assay::cli::PrepareStreams();
  return static_cast<int>(assay::cli::RunCommandLine({argv, argv + argc}));
}
