#include "sim/scenario/models_folder.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/base/module.h"

namespace assay::scenario {
namespace {

namespace fs = std::filesystem;

bool Has(const fs::path& folder, const char* kind) {
  std::error_code error;
  return fs::is_directory(folder / kind, error);
}

// Returns the folders `models` beside the file and above it, up to the nearest with workcells in
// it.
std::vector<fs::path> AboveOf(const fs::path& file) {
  std::vector<fs::path> found;
  std::error_code error;
  fs::path folder = fs::weakly_canonical(fs::absolute(file), error).parent_path();
  while (true) {
    const fs::path models = folder / "models";
    const bool has_workcells = Has(models, "workcells");
    if (has_workcells || Has(models, "parts")) found.push_back(models);
    if (has_workcells || folder == folder.parent_path()) return found;
    folder = folder.parent_path();
  }
}

bool HaveWorkcells(const std::vector<fs::path>& folders) {
  return std::ranges::any_of(folders, [](const fs::path& f) { return Has(f, "workcells"); });
}

// If no folder above the file has workcells, the models of the program come last.
std::vector<fs::path> BelongingTo(const fs::path& scenario_file) {
  std::vector<fs::path> folders = AboveOf(scenario_file);
  if (!HaveWorkcells(folders)) folders.push_back(ModelsOfTheProgram());
  return folders;
}

void RequireModels(const fs::path& folder) {
  if (Has(folder, "parts") || Has(folder, "workcells")) return;
  throw InputError({.file = folder.string()}, "not a folder of models",
                   "a folder with 'parts' or 'workcells' in it");
}

}  // namespace

fs::path ModelsOfTheProgram() {
  const fs::path program = FileOfThisCode();
  for (fs::path folder = program; folder != folder.root_path(); folder = folder.parent_path()) {
    const fs::path installed = folder / "share/assay/models";
    if (Has(installed, "workcells")) return installed;
  }
  if (program.empty()) return program;
  const std::vector<fs::path> above = AboveOf(program);
  return HaveWorkcells(above) ? above.back() : fs::path();
}

domain::ModelPath FindModels(const fs::path& scenario_file, const domain::ModelPath& given) {
  std::ranges::for_each(given.folders(), RequireModels);
  domain::ModelPath models = given;
  for (const fs::path& usual : BelongingTo(scenario_file)) {
    const auto is_usual = [&](const fs::path& folder) {
      std::error_code error;
      return fs::equivalent(folder, usual, error);
    };
    if (std::ranges::none_of(given.folders(), is_usual)) models.Append(usual);
  }
  if (HaveWorkcells(models.folders())) return models;
  throw InputError({.file = scenario_file.string()}, "no folder of models belongs to it",
                   "a folder 'models' with 'workcells' in it, beside the file or above it, or "
                   "named with --models");
}

}  // namespace assay::scenario
