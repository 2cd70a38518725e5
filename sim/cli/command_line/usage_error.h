#pragma once

#include <stdexcept>

namespace assay::cli {

// An error of the command line that is found only when the input is read. For example, an option
// may name something that the input does not have.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace assay::cli
