#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace assay::architecture {

// Each function reads the source tree under `root` and returns the breaches of one rule. Each
// breach is one line, "FILE:LINE: what". Sources are the .h and .cc files under planner/ and sim/,
// in the layout of clang-format.

// A source file has at most `most` lines.
std::vector<std::string> LongFiles(const std::filesystem::path& root, int most);

// The body of a function has at most `most` lines between its braces.
std::vector<std::string> LongFunctions(const std::filesystem::path& root, int most);

// The body of a class in a .cc file has at most `most` lines between its braces.
std::vector<std::string> LongClasses(const std::filesystem::path& root, int most);

// The README.md of a library or of a top-level folder has at most `most` lines.
std::vector<std::string> LongReadmes(const std::filesystem::path& root, int most);

// The README.md of the root has at most so many lines and words. Words are what white space
// separates.
std::vector<std::string> LongRootReadme(const std::filesystem::path& root, int most_lines,
                                        int most_words);

}  // namespace assay::architecture
