#pragma once

#include <string>

namespace assay {

// A shared library of ours that is opened when it is first needed: behind it stand libraries of
// other people's that take longer to open than most verbs take to run. It is found where the
// RUNPATH of the program points (of the shared library, where our libraries are linked into one).
struct Module {
  std::string file;             // "libassay_opencv.so"
  std::string entry;            // a function without arguments that returns what the module offers
  std::string needed_for;       // plural, as the error message starts: "pictures"
  std::string debian_packages;  // of the libraries behind it
};

// Opens the module and returns its entry. Throws EnvironmentError, which names the Debian packages,
// if there is no such module, or if a library that it needs is missing.
void* EntryOf(const Module& module);

// The one instance of what the module offers. Its entry returns a pointer to it.
template <class Interface>
const Interface& Open(const Module& module) {
  return *reinterpret_cast<const Interface* (*)()>(EntryOf(module))();
}

}  // namespace assay
