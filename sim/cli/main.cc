#include "sim/cli/command_line.h"

int main(int argc, char** argv) {
  return static_cast<int>(assay::cli::RunCommandLine({argv, argv + argc}));
}
