#pragma once

namespace assay::cli {

// While it lives, SIGINT and SIGTERM (a key, a cluster's time limit) do not end the program but are
// taken down, so that what is being written can be finished; the second one ends it. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool Requested();  // from any thread
};

}  // namespace assay::cli
