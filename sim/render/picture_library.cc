#include "sim/render/picture_library.h"

#include <dlfcn.h>

#include <filesystem>

#include "planner/base/input_error.h"

namespace assay::render {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModule = "libassay_opencv.so";
constexpr const char* kEntry = "AssayPictureLibrary";

// Beside the program, in the build tree as in an installed one: bin/assay, lib/assay/MODULE.
fs::path BesideTheProgram() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "lib/assay" / kModule;
}

// Never closed: OpenCV's threads may outlive everything else. A program of other people's finds the
// module where the dynamic linker looks for libraries.
void* OpenModule() {
  if (void* const beside = dlopen(BesideTheProgram().c_str(), RTLD_LAZY)) return beside;
  const std::string why = dlerror();
  if (void* const found = dlopen(kModule, RTLD_LAZY)) return found;
  throw EnvironmentError("pictures need the module " + std::string(kModule) + ": " + why +
                         "; apt-get install libopencv-imgcodecs406 libopencv-imgproc406");
}

const PictureLibrary& OpenLibrary() {
  void* const entry = dlsym(OpenModule(), kEntry);
  if (entry == nullptr) throw EnvironmentError(std::string(kModule) + " is of another version");
  return *reinterpret_cast<const PictureLibrary* (*)()>(entry)();
}

}  // namespace

const PictureLibrary& Pictures() {
  static const PictureLibrary& library = OpenLibrary();
  return library;
}

}  // namespace assay::render
