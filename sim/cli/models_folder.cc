#include "sim/cli/models_folder.h"

#include "planner/base/input_error.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {

namespace fs = std::filesystem;

fs::path FindModels(const fs::path& given, const fs::path& input) {
  return given.empty() ? scenario::FindModels(input) : scenario::RequireModels(given);
}

fs::path FindModelsHere(const fs::path& given) {
  try {
    const fs::path here = fs::current_path();
    return FindModels(given, here / "any file").lexically_proximate(here);
  } catch (const InputError&) {
    throw EnvironmentError("no folder 'models' here, nor above; name it with --models");
  }
}

}  // namespace assay::cli
