#include "sim/cli/options/models_folder.h"

#include <functional>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {

namespace fs = std::filesystem;

void AddModelsOption(CLI::App& command, domain::ModelPath& models) {
  const std::function<void(const std::vector<std::string>&)> take =
      [&models](const std::vector<std::string>& folders) {
        for (const std::string& folder : folders) models.Append(folder);
      };
  command
      .add_option_function("--models", take,
                           "folder with parts/ or workcells/, which is searched before the "
                           "program's own models; may be given several times")
      ->check(CLI::ExistingDirectory)
      ->allow_extra_args(false);
}

domain::ModelPath FindModelsHere(const domain::ModelPath& given) {
  const fs::path here = fs::current_path();
  domain::ModelPath found;
  try {
    found = scenario::FindModels(here / "any file", given);
  } catch (const InputError&) {
    if (!given.empty()) throw;
    throw EnvironmentError("no folder 'models' here, nor above; name it with --models");
  }
  domain::ModelPath shown;
  for (const fs::path& folder : found.folders()) shown.Append(folder.lexically_proximate(here));
  return shown;
}

}  // namespace assay::cli
