#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/page_output/execution_page.h"
#include "sim/cli/shown_executions/request_options.h"
#include "sim/cli/tasks/output_file.h"

namespace assay::cli {
namespace view_verb {

struct Options {
  ShowRequest request;
  std::filesystem::path page;
};

ExitCode Execute(const Options& options) {
  RequireWritable(options.page);
  const ShownExecution shown = ExecutionOf(options.request);
  const std::string page = ExecutionPage(shown);
  WriteFile(options.page, page);
  Print(fmt::format("{}: {:.1f} s in {} kB\n", options.page.string(),
                    shown.trace.end().snapshot.time, (page.size() + 500) / 1000));
  return shown.code;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  AddShowOptions(command, options->request);
  command.add_option("-o,--output", options->page, "HTML file to write")->required();
  return [options] { return Execute(*options); };
}

}  // namespace view_verb

const Verb kView = {
    .name = "view",
    .summary = "writes a page that shows an execution in three dimensions, with its certificates",
    .page = "sim/viewing.md",
    .example =
        "assay view scenarios/spar-fig13.yaml -o out/fig13.html\n"
        "  assay view fig15.sqlite 17 -o out/trial-17.html",
    .declare = view_verb::Declare,
};

}  // namespace assay::cli
