#include "sim/scenario/models_folder.h"

#include "planner/base/input_error.h"

namespace assay::scenario {
namespace {

namespace fs = std::filesystem;

bool IsModels(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "workcells", error);
}

fs::path Installed() {
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : executable.parent_path().parent_path() / "share/assay/models";
}

}  // namespace

fs::path FindModels(const fs::path& scenario_file) {
  std::error_code error;
  fs::path folder = fs::weakly_canonical(fs::absolute(scenario_file), error).parent_path();
  while (true) {
    if (IsModels(folder / "models")) return folder / "models";
    if (folder == folder.parent_path()) break;
    folder = folder.parent_path();
  }
  if (IsModels(Installed())) return Installed();
  throw InputError({.file = scenario_file.string()}, "no folder of models belongs to it",
                   "a folder 'models' with 'workcells' in it, beside the file or above it, or "
                   "named with --models");
}

fs::path RequireModels(const fs::path& folder) {
  if (IsModels(folder)) return folder;
  throw InputError({.file = folder.string()}, "not a folder of models",
                   "a folder with 'workcells' in it");
}

}  // namespace assay::scenario
