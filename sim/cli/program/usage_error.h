#pragma once

#include <stdexcept>

namespace assay::cli {

// The command line asks for what there is not, as turns out only when the input is read.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace assay::cli
