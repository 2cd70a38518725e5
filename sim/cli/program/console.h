#pragma once

#include <functional>
#include <string_view>

namespace assay::cli {

// The streams 0, 1 and 2 exist from now on: one that was closed can be neither read nor written,
// and no file that is opened later is taken for it. A reader that went away is an error of the
// write, not the end of the program. Called once, first of all.
void PrepareStreams();

// Results go to standard output, shown as planner/base/document/quotation.h says. Both throw
// EnvironmentError if it cannot be written.
void Print(std::string_view text);
void FlushOutput();

// Prints the result and writes its files, each even if the other cannot be done; then throws what
// could not.
void PrintAndWrite(std::string_view text, const std::function<void()>& write);

// One line to standard error, "assay: ...", whatever line breaks the message has.
void PrintError(std::string_view message);

// What is said beside the result, to standard error: nobody misses it where that cannot be written.
void Remark(std::string_view text);
// Whether people on a terminal read remarks.
bool RemarksAreSeen();

}  // namespace assay::cli
