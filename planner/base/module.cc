#include "planner/base/module.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

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

std::filesystem::path FileOfThisCode() {
  Dl_info ignored;
  void* found = nullptr;
  const auto* const here = reinterpret_cast<const void*>(&FileOfThisCode);
  if (dladdr1(here, &ignored, &found, RTLD_DL_LINKMAP) == 0) return {};
  const std::string name = static_cast<const link_map*>(found)->l_name;
  std::error_code error;
  // The program itself has no name there.
  const std::filesystem::path file =
      std::filesystem::canonical(name.empty() ? "/proc/self/exe" : name, error);
  return error ? std::filesystem::path() : file;
}

}  // namespace assay
