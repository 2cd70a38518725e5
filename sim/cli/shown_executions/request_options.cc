#include "sim/cli/shown_executions/request_options.h"

#include <CLI/CLI.hpp>
#include <limits>

#include "sim/cli/options/models_folder.h"

namespace assay::cli {

void AddShowOptions(CLI::App& command, ShowRequest& request) {
  request.verb = command.get_name();
  command
      .add_option("input", request.input,
                  "scenario file or plan file, which is executed once without noise; a trace; the "
                  "database of a sweep; or the result.json of a run under noise")
      ->required();
  const CLI::Range numbers(1, std::numeric_limits<int>::max());
  command
      .add_option("number", request.number,
                  "number of the trial in a database, of the trial or counterexample in a "
                  "result.json, or of the trial of a plan tree (1 if left out)")
      ->check(numbers);
  command
      .add_option("--counterexample", request.counterexample,
                  "number of the counterexample, if the trial of the database is a falsification; "
                  "1 if left out")
      ->check(numbers);
  command
      .add_option_function<std::string>(
          "--worlds",
          [&request](const std::string& worlds) { request.is_every_leaf = worlds == "all"; },
          "for a plan tree: drawn: hidden facts are drawn; all: the trials go through the leaves "
          "and repeats of the tree in turn")
      ->check(CLI::IsMember({"drawn", "all"}));
  command.add_option(
      "--plan", request.plan,
      "plan file that belongs to a trace or a result.json; plan.json beside it if left out");
  AddModelsOption(command, request.models);
}

}  // namespace assay::cli
