#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace assay::architecture {

// Each function reads the source tree under `root` and returns the breaches of one rule. Each
// breach is one line, "FILE:LINE: what". The rules refer to the table of libraries in the root
// CMakeLists.txt.

// A folder may include files of its own and files of the folders that it uses. Includes are written
// from the root.
std::vector<std::string> CrossedBorders(const std::filesystem::path& root);

// Nothing under planner/ includes the simulator or the renderer.
std::vector<std::string> CrossedMujocoLine(const std::filesystem::path& root);

// X.cc includes X.h before anything else. Each header with a .cc therefore compiles by itself.
std::vector<std::string> OwnHeaderNotFirst(const std::filesystem::path& root);

// Headers do not include the libraries that are slow to compile.
std::vector<std::string> HeavyHeaders(const std::filesystem::path& root);

// Every source file under planner/ and sim/ belongs to a library. The program in sim/cli is an
// exception.
std::vector<std::string> FilesOfNoLibrary(const std::filesystem::path& root);

// Each library includes something of every library that the table lets it use.
std::vector<std::string> UnusedLibraries(const std::filesystem::path& root);

// No file includes itself, directly or indirectly. X.h and X.cc count as one file. Each line names
// the files of a cycle.
std::vector<std::string> Cycles(const std::filesystem::path& root);

// A folder holds at most `most` source files.
std::vector<std::string> CrowdedFolders(const std::filesystem::path& root, int most);

}  // namespace assay::architecture
