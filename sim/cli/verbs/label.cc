#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "planner/network/constraint_network/network_file.h"
#include "planner/network/labeling/count.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/tasks/output_file.h"

namespace assay::cli {
namespace label_verb {

using Json = nlohmann::ordered_json;
using network::LabelRequest;

struct Options {
  std::filesystem::path network;
  std::filesystem::path output;
  LabelRequest request = LabelRequest::kFirst;
  std::int64_t budget = 100'000'000;
};

Json ToJson(const network::NamedLabeling& labeling) {
  Json json = Json::object();
  auto& object = json.get_ref<Json::object_t&>();
  for (const auto& [node, label] : labeling) object.emplace_back(node, label);
  return json;
}

Json ToJson(const network::LabelReport& report, LabelRequest request, double seconds) {
  Json json = {{"outcome", Name(report.outcome, "labeled")}};
  if (request == LabelRequest::kFirst && !report.labelings.empty()) {
    json["labeling"] = ToJson(report.labelings.front());
  }
  if (request == LabelRequest::kAll) {
    json["labelings"] = Json::array();
    for (const auto& labeling : report.labelings) json["labelings"].push_back(ToJson(labeling));
  }
  if (report.count) {
    json["count"] = *report.count;
    if (*report.count == network::kManyLabelings) json["or_more"] = true;
  }
  json["visited"] = report.counters.visited;
  json["seconds"] = seconds;
  return json;
}

ExitCode Execute(const Options& options) {
  const network::NamedNetwork named = network::LoadNetwork(options.network);
  RequireWritable(options.output);
  const Stopwatch stopwatch;
  Budget budget(options.budget);
  const network::LabelReport report = [&] {
    const Progress progress("labeling " + options.network.string());
    return network::LabelNetwork(named, options.request, budget);
  }();
  const std::string text = plan::JsonText(ToJson(report, options.request, stopwatch.Seconds()));
  if (options.output.empty()) {
    Print(text);
  } else {
    WriteFile(options.output, text);
  }
  return ExitCodeOf(report.outcome);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("network", options->network, "constraint network, JSON or YAML")->required();
  const auto add_request = [&](const char* name, LabelRequest request, const char* what) {
    return command.add_flag_callback(
        name, [options, request] { options->request = request; }, what);
  };
  CLI::Option* const first = add_request("--first", LabelRequest::kFirst, "one labeling (default)");
  CLI::Option* const all = add_request("--all", LabelRequest::kAll, "every labeling");
  CLI::Option* const count =
      add_request("--count", LabelRequest::kCount, "how many labelings, without listing them");
  first->excludes(all)->excludes(count);
  all->excludes(count);
  command.add_flag_callback(
      "--json", [] {}, "print JSON; this is also the default");
  command.add_option("-o,--output", options->output, "write to this file instead of printing");
  command.add_option("--budget", options->budget, "limit of visited nodes of the search tree")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  return [options] { return Execute(*options); };
}

}  // namespace label_verb

const Verb kLabel = {
    .name = "label",
    .summary = "labels a binary constraint network",
    .page = "planner/bounds-and-labels.md",
    .example =
        "assay label network.json --count\n"
        "  where network.json is\n"
        "  {\"nodes\": {\"v\": [\"a\", \"b\"], \"w\": 3},\n"
        "   \"arcs\": [{\"between\": [\"v\", \"w\"], \"pairs\": [[\"a\", 0], [\"b\", 2]]}]}",
    .declare = label_verb::Declare,
};

}  // namespace assay::cli
