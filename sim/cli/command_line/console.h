#pragma once

#include <functional>
#include <string_view>

namespace assay::cli {

// Makes sure that the streams 0, 1 and 2 exist. A stream that was closed can then be neither read
// nor written, and no file that is opened later takes its number. If a reader goes away, the write
// fails, and the program does not end. Must be called once, before anything else.
void PrepareStreams();

// Results go to standard output, in the form of planner/base/input_files/quotation.h. Both
// functions throw EnvironmentError if standard output cannot be written.
void Print(std::string_view text);
void FlushOutput();

// Prints the result and writes its files. Each is done even if the other fails; then the failure is
// thrown.
void PrintAndWrite(std::string_view text, const std::function<void()>& write);

// Prints "assay: ..." to standard error in one line, whatever line breaks the message has.
void PrintError(std::string_view message);

// Prints a remark beside the result to standard error. A failure to write it is ignored.
void Remark(std::string_view text);
// Returns whether remarks go to a terminal, where people read them.
bool RemarksAreSeen();

}  // namespace assay::cli
