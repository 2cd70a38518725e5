#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include "planner/base/check.h"
#include "planner/base/counted.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/page_output/execution_page.h"
#include "sim/cli/picture_output/step_pictures.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/stored_trial.h"
#include "sim/execution/walk/executor.h"
#include "sim/report/findings/csv.h"
#include "sim/report/findings/read_findings.h"
#include "sim/report/html/page.h"

namespace assay::cli {
namespace report_verb {

namespace fs = std::filesystem;

struct Options {
  fs::path database;
  fs::path page;
  fs::path tables;  // folder; empty: no tables
  fs::path views;   // folder; empty: no pages in three dimensions
  domain::ModelPath models;
  int cells_in_full = report::PageOptions().cells_in_full;
  bool pictures = false;
  PictureOptions picture = {.quality = {.size = "400x300"}};
};

// A folder for temporary files, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(fs::temp_directory_path() / fmt::format("assay-report-{}", getpid())) {
    MakeFolder(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  const fs::path path_;
};

// Executes a stored trial once more and returns its contact sheet, the content of a PNG file.
std::string ContactSheetOf(const sweep::Store& store, int number, const Options& options) {
  const std::optional<sweep::TrialRecord> trial = store.FindTrial(number);
  ASSAY_CHECK(trial.has_value(), "a notable trial that is not there: {}", number);
  const Progress progress(fmt::format("pictures of trial {}", number));
  const sweep::PlannedCell cell = RestoredCell(store, *trial, options.models);
  const scenario::Scenario& scenario = cell.preparation->scenario;
  const noise::Noise noise = sweep::NoiseOf(cell, trial->number);
  const scene::Scene scene(scenario.problem,
                           execution::TrueScene(scenario.simulation.scene, noise));
  StepPictures pictures({scenario.problem, cell.preparation->plan, scene},
                        scenario.simulation.cameras, options.picture);
  sweep::Execute(cell, noise, &pictures);
  const TemporaryFolder folder;
  pictures.Write(folder.path());
  std::ifstream in(folder.path() / pictures.FileNames().back(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void WriteTables(const report::Findings& findings, const fs::path& folder) {
  for (const report::CsvFile& file : report::CsvFiles(findings)) {
    WriteFile(folder / file.name, file.text);
  }
}

// Returns the address of a file as seen from a page. Browsers read some characters as more than
// letters of a name.
std::string AddressOf(const fs::path& file, const fs::path& page) {
  std::string address;
  for (const char c :
       fs::absolute(file).lexically_relative(fs::absolute(page).parent_path()).generic_string()) {
    const bool is_special = c == '%' || c == '#' || c == '?' || c == ' ' || c == ':';
    address += is_special ? fmt::format("%{:02X}", static_cast<int>(c)) : std::string(1, c);
  }
  return address;
}

std::string WriteView(const report::ViewedTrial& viewed, const Options& options) {
  const fs::path file = options.views / viewed.FileName();
  const ShowRequest request = {.verb = "report",
                               .input = options.database,
                               .number = viewed.trial,
                               .counterexample = viewed.counterexample,
                               .models = options.models};
  WriteFile(file, ExecutionPage(StoredTrialExecution(request)));
  return AddressOf(file, options.page);
}

ExitCode Execute(const Options& options) {
  const sweep::Store store = sweep::Store::Open(options.database);
  RequireWritable(options.page);
  for (const fs::path& folder : {options.tables, options.views}) {
    if (!folder.empty()) MakeFolder(folder);
  }
  const report::Findings findings = [&] {
    const Progress progress("reading " + options.database.string());
    return report::ReadFindings(store, options.database.string());
  }();
  report::PageOptions page{.cells_in_full = options.cells_in_full};
  if (options.pictures) {
    page.picture = [&](int trial) { return ContactSheetOf(store, trial, options); };
  }
  if (!options.views.empty()) {
    page.view = [&](const report::ViewedTrial& viewed) { return WriteView(viewed, options); };
  }
  WriteFile(options.page, report::Page(findings, page));
  if (!options.tables.empty()) WriteTables(findings, options.tables);
  Print(fmt::format("{}: {} in {}\n", options.page.string(), Counted(findings.done(), "trial"),
                    Counted(std::ssize(findings.cells), "cell")));
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("database", options->database, "database of a sweep")->required();
  command.add_option("-o,--output", options->page, "HTML file for the page")->required();
  command.add_option("--csv", options->tables, "folder for the tables, as CSV files");
  command.add_option("--views", options->views,
                     "folder for pages that show in three dimensions each failed trial and each "
                     "counterexample that the report lists");
  command
      .add_option("--cells", options->cells_in_full,
                  "largest number of cells whose certificates are shown step by step")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command.add_flag("--pictures", options->pictures,
                   "execute the best, the typical and the worst trial again, with pictures");
  AddPictureOptions(command, options->picture, "--pictures");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace report_verb

const Verb kReport = {
    .name = "report",
    .summary = "makes an HTML page and tables of the results of a sweep",
    .page = "sim/sweeps.md",
    .example = "assay report fig15.sqlite -o fig15.html --csv fig15-tables --pictures",
    .declare = report_verb::Declare,
};

}  // namespace assay::cli
