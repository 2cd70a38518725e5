#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace assay::architecture {

// Each function reads the source tree under `root` and returns its breaches, one line each:
// "FILE:LINE: what". The rules are those of the table of libraries in the root CMakeLists.txt.

// A folder includes from itself and from what it uses, and writes its includes from the root.
std::vector<std::string> CrossedBorders(const std::filesystem::path& root);

// Nothing under planner/ knows the simulator, nor what draws.
std::vector<std::string> CrossedMujocoLine(const std::filesystem::path& root);

// X.cc includes X.h before anything else: so each header with a .cc compiles by itself.
std::vector<std::string> OwnHeaderNotFirst(const std::filesystem::path& root);

// Headers do without the libraries that are slow to compile.
std::vector<std::string> HeavyHeaders(const std::filesystem::path& root);

// Every source file under planner/ and sim/ belongs to a library, but for the program in sim/cli.
std::vector<std::string> FilesOfNoLibrary(const std::filesystem::path& root);

// Each library includes something of every library that the table lets it use.
std::vector<std::string> UnusedLibraries(const std::filesystem::path& root);

// No file includes, by whatever way, one that includes it. X.h and X.cc count as one file. Each
// line names the files of a cycle.
std::vector<std::string> Cycles(const std::filesystem::path& root);

// A folder holds at most `most` source files.
std::vector<std::string> CrowdedFolders(const std::filesystem::path& root, int most);

}  // namespace assay::architecture
