#include "sim/cli/models_folder.h"

#include <array>
#include <system_error>

#include "planner/base/input_error.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

bool HoldsModels(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "parts", ignored) &&
         fs::is_directory(folder / "workcells", ignored);
}

// In the folder or in one that it lies in; empty if there is none.
fs::path FindUpwards(fs::path folder) {
  while (true) {
    for (const char* name : {"models", "share/assay/models"}) {
      if (HoldsModels(folder / name)) return folder / name;
    }
    if (folder == folder.parent_path()) return {};
    folder = folder.parent_path();
  }
}

}  // namespace

fs::path FindModels(const fs::path& given, const fs::path& input) {
  if (!given.empty()) return given;
  std::error_code ignored;
  const std::array starts = {fs::absolute(input, ignored).parent_path(), fs::current_path(ignored),
                             fs::read_symlink("/proc/self/exe", ignored).parent_path()};
  for (const fs::path& start : starts) {
    if (fs::path found = FindUpwards(start); !found.empty())
      return found.lexically_proximate(fs::current_path(ignored));
  }
  throw EnvironmentError("no folder 'models' with parts and workcells; name it with --models");
}

}  // namespace assay::cli
