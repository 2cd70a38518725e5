#include "sim/cli/command_line/command_line.h"
#include "sim/cli/command_line/console.h"

int main(int argc, char** argv) {
  assay::cli::PrepareStreams();
  return static_cast<int>(assay::cli::RunCommandLine({argv, argv + argc}));
}
