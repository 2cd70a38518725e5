#pragma once

#include <string>
#include <utility>

#include "sim/cli/shown_executions/shown_execution.h"

namespace assay::python {

// One executed trial with its trace.
class TracedTrial {
 public:
  explicit TracedTrial(cli::ShownExecution shown) : shown_(std::move(shown)) {}

  std::string Lines() const;  // trace.jsonl
  std::string Page() const;   // the page of `assay view`

 private:
  const cli::ShownExecution shown_;
};

}  // namespace assay::python
