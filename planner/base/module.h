#pragma once

#include <filesystem>
#include <string>

namespace assay {

// A shared library of this program that is opened on first use. It depends on third-party libraries
// that take longer to open than most verbs take to run. It is found by the RUNPATH of the program.
// If all libraries of this program are linked into one shared library, it is found by the RUNPATH
// of that library.
struct Module {
  std::string file;             // for example "libassay_opencv.so"
  std::string entry;            // a function without arguments that returns the module's interface
  std::string needed_for;       // a plural that starts the error message: "pictures"
  std::string debian_packages;  // the packages of the third-party libraries
};

// Opens the module and returns the address of its entry. Throws EnvironmentError, which names the
// Debian packages, if the module or a library that it needs is missing.
void* EntryOf(const Module& module);

// Returns the only instance of the module's interface. The module's entry returns a pointer to it.
template <class Interface>
const Interface& Open(const Module& module) {
  return *reinterpret_cast<const Interface* (*)()>(EntryOf(module))();
}

// Returns the path of the file that this library is linked into: the program, or a shared library
// that holds all libraries of this program. Returns an empty path if the system does not tell.
std::filesystem::path FileOfThisCode();

}  // namespace assay
