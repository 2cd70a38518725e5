#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/cli/command_line/exit_code.h"

namespace assay::python {

// An answer that is no plan. Python gets the exception of the exit code (assay/errors.py).
struct Refused {
  cli::ExitCode code;
  std::string text;                                         // what the program would print
  std::shared_ptr<const nlohmann::ordered_json> json = {};  // for programs; may be null
};

}  // namespace assay::python
