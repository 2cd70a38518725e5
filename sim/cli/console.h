#pragma once

#include <string_view>

namespace assay::cli {

// Results go to standard output. Both throw EnvironmentError if it cannot be written.
void Print(std::string_view text);
void FlushOutput();

// One line to standard error, "assay: ...", whatever line breaks the message has.
void PrintError(std::string_view message);

}  // namespace assay::cli
