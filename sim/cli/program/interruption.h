#pragma once

#include <string>

#include "sim/cli/program/exit_code.h"

namespace assay::cli {

// What ends a trial from inside once an interruption is requested; its result is lost.
struct BrokenOff {};

// While it lives, SIGINT, SIGTERM and SIGHUP (a key, a cluster's time limit, a terminal that is
// closed) do not end the program but are taken down, so that what is there can be printed and
// written; the second one ends it. Signals that were ignored before (nohup) stay so. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  // From any thread.
  static bool Requested();
  static void BreakOffIfRequested();  // throws BrokenOff

  // How the program ends: `code`, unless it was interrupted.
  static ExitCode CodeOr(ExitCode code);
  // "interrupted: 3 of 20 trials were made\n"; empty if it was not.
  static std::string Text(long long made, long long wanted, const char* what = "trials");
};

}  // namespace assay::cli
