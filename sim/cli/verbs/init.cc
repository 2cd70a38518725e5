#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <system_error>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace init_verb {

namespace fs = std::filesystem;

struct Options {
  fs::path folder;
};

constexpr const char* kScenario = "plate-on-stud.yaml";
constexpr const char* kSweep = "clearances.yaml";
// The files of the folder scenarios/start of the program, which are copied.
constexpr std::array kFiles = {"README.md", kScenario, "models/parts/stud/part.yaml",
                               "models/parts/plate/part.yaml", kSweep};
constexpr std::size_t kMostBytes = std::size_t{1} << 20;

fs::path StartFolder() {
  const fs::path models = scenario::ModelsOfTheProgram();
  if (models.empty()) throw EnvironmentError("the files that come with the program are missing");
  return models.parent_path() / "scenarios/start";
}

// Nothing is written if anything is there.
void RefuseToOverwrite(const fs::path& folder) {
  for (const char* file : kFiles) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder / file, error))) continue;
    throw UsageError(fmt::format("init: {} is there already; allowed: a folder without it",
                                 Quote((folder / file).string())));
  }
}

ExitCode Execute(const Options& options) {
  const fs::path& folder = options.folder;
  RefuseToOverwrite(folder);
  const fs::path start = StartFolder();
  std::string text;
  for (const char* file : kFiles) {
    MakeFolder((folder / file).parent_path());
    WriteFile(folder / file, ReadInput(start / file, "a file of the program", kMostBytes));
    text += fmt::format("{}\n", (folder / file).string());
  }
  text += fmt::format(
      "\nNow try:\n  assay plan {0}/{1}\n  assay run {0}/{1} --noise uniform --trials 4\n  assay "
      "sweep {0}/{2}\n{0}/README.md describes the files.\n",
      folder.string(), kScenario, kSweep);
  Print(text);
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option(
          "folder", options->folder,
          "folder for the files, which is made if it does not exist; no file is overwritten")
      ->required();
  return [options] { return Execute(*options); };
}

}  // namespace init_verb

const Verb kInit = {
    .name = "init",
    .summary = "writes a template for your own assembly: a scenario, two parts and a sweep",
    .page = "scenarios/your-own-part.md",
    .example = "assay init own\n  assay plan own/plate-on-stud.yaml",
    .declare = init_verb::Declare,
};

}  // namespace assay::cli
