#include "planner/base/module.h"

#include <dlfcn.h>

#include "planner/base/input_files/input_error.h"

namespace assay {

// The module is never closed, because threads of third-party libraries may outlive everything else.
void* EntryOf(const Module& module) {
  void* const opened = dlopen(module.file.c_str(), RTLD_LAZY);
  if (opened == nullptr) {
    throw EnvironmentError(module.needed_for + " need the module " + module.file + ": " +
                           dlerror() + "; apt-get install " + module.debian_packages);
  }
  void* const entry = dlsym(opened, module.entry.c_str());
  if (entry == nullptr) throw EnvironmentError(module.file + " is of another version");
  return entry;
}

}  // namespace assay
