#include "sim/scenario/models_folder.h"

#include <algorithm>
#include <optional>

#include "planner/base/input_files/input_error.h"
#include "planner/base/module.h"

namespace assay::scenario {
namespace {

namespace fs = std::filesystem;

bool Has(const fs::path& folder, const char* kind) {
  std::error_code error;
  return fs::is_directory(folder / kind, error);
}

// Returns the nearest `models` with workcells in it, beside the file or above it; empty if there is
// none.
fs::path AboveOf(const fs::path& file) {
  std::error_code error;
  fs::path folder = fs::weakly_canonical(fs::absolute(file), error).parent_path();
  while (true) {
    if (Has(folder / "models", "workcells")) return folder / "models";
    if (folder == folder.parent_path()) return {};
    folder = folder.parent_path();
  }
}

// Returns the models that were installed with this program. If there are none, returns the models
// of the tree in which it was built.
fs::path OfTheProgram() {
  const fs::path program = FileOfThisCode();
  for (fs::path folder = program; folder != folder.root_path(); folder = folder.parent_path()) {
    const fs::path installed = folder / "share/assay/models";
    if (Has(installed, "workcells")) return installed;
  }
  return program.empty() ? program : AboveOf(program);
}

fs::path BelongingTo(const fs::path& scenario_file) {
  const fs::path above = AboveOf(scenario_file);
  return above.empty() ? OfTheProgram() : above;
}

void RequireModels(const fs::path& folder) {
  if (Has(folder, "parts") || Has(folder, "workcells")) return;
  throw InputError({.file = folder.string()}, "not a folder of models",
                   "a folder with 'parts' or 'workcells' in it");
}

}  // namespace

domain::ModelPath FindModels(const fs::path& scenario_file, const domain::ModelPath& given) {
  std::ranges::for_each(given.folders(), RequireModels);
  domain::ModelPath models = given;
  const fs::path usual = BelongingTo(scenario_file);
  const auto is_usual = [&](const fs::path& folder) {
    std::error_code error;
    return fs::equivalent(folder, usual, error);
  };
  if (std::ranges::none_of(given.folders(), is_usual)) models.Append(usual);
  const auto has_workcells = [](const fs::path& folder) { return Has(folder, "workcells"); };
  if (std::ranges::any_of(models.folders(), has_workcells)) return models;
  throw InputError({.file = scenario_file.string()}, "no folder of models belongs to it",
                   "a folder 'models' with 'workcells' in it, beside the file or above it, or "
                   "named with --models");
}

}  // namespace assay::scenario
