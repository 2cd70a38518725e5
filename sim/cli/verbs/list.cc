#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "planner/base/input_files/document.h"
#include "planner/base/input_files/input_error.h"
#include "planner/domain/actions/actions.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/plan_output/table.h"
#include "sim/execution/predicates/quantity.h"
#include "sim/execution/skills/skill.h"

namespace assay::cli {
namespace list_verb {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Options {
  std::string kind;  // empty: all
  domain::ModelPath models;
  bool json = false;
};

struct Entry {
  std::string name;
  std::string text;        // one line
  std::string error = {};  // the reason if there is no text
};
using Entries = std::vector<Entry>;

std::vector<fs::path> SortedContents(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) paths.push_back(entry.path());
  std::ranges::sort(paths);
  return paths;
}

std::string TextAt(const Document& document, const char* key) {
  const std::optional<Value> value = document.root().Find(key);
  return value ? value->Text() : "";
}

// A file that cannot be read does not hide the others: its error is listed in its place.
Entry EntryOf(std::string name, const std::function<std::string()>& text) {
  try {
    return {.name = std::move(name), .text = text()};
  } catch (const InputError& error) {
    return {.name = std::move(name), .text = "", .error = error.what()};
  }
}

// Lists the scenarios beside each folder of models.
Entries ListScenarios(const domain::ModelPath& models) {
  std::set<fs::path> folders;
  for (const fs::path& folder : models.folders())
    folders.insert(folder.parent_path() / "scenarios");
  Entries entries;
  for (const fs::path& folder : folders) {
    for (const fs::path& file : SortedContents(folder)) {
      if (file.extension() != ".yaml") continue;
      entries.push_back(
          EntryOf(file.string(), [&] { return TextAt(Document::Load(file), "title"); }));
    }
  }
  return entries;
}

std::string FeaturesIn(const fs::path& part_file) {
  std::vector<std::string> features;
  const Document document = Document::Load(part_file);
  for (const auto& [number, feature] : document.root().At("features").Entries()) {
    const auto what = feature.Find("what");
    if (!what) continue;
    const std::vector<Value> names = what->IsList() ? what->Items() : std::vector<Value>{*what};
    for (const Value& name : names) features.push_back(name.Text());
  }
  return fmt::format("{}", fmt::join(features, ", "));
}

// Lists the parts with their features in the part file's words.
Entries ListParts(const domain::ModelPath& models) {
  Entries entries;
  for (const std::string& name : models.Parts()) {
    entries.push_back(EntryOf(name, [&] { return FeaturesIn(models.PartFile(name)); }));
  }
  return entries;
}

// Returns "sensors: overhead-camera" for a section that a workcell file may have.
std::string NamesIn(const Document& document, const char* section) {
  const std::optional<Value> value = document.root().Find(section);
  if (!value) return "";
  std::vector<std::string> names;
  for (const auto& [name, ignored] : value->Entries()) names.push_back(name.Text());
  return fmt::format("; {}: {}", section, fmt::join(names, ", "));
}

Entries ListWorkcells(const domain::ModelPath& models) {
  Entries entries;
  for (const std::string& name : models.Workcells()) {
    entries.push_back(EntryOf(name, [&] {
      const Document document = Document::Load(models.WorkcellFile(name));
      std::string text = TextAt(document, "description");
      for (const char* section : {"sensors", "verifications", "recoveries"}) {
        text += NamesIn(document, section);
      }
      return text;
    }));
  }
  return entries;
}

Entries ListActions(const domain::ModelPath&) {
  Entries entries;
  for (const domain::ActionKind* kind : domain::StandardActions()) {
    if (kind->achieve == nullptr) continue;
    entries.push_back({.name = std::string(kind->name), .text = std::string(kind->summary)});
  }
  return entries;
}

template <class Words>
Entries ListWords(const Words& words) {
  Entries entries;
  for (const auto* word : words) {
    entries.push_back({.name = std::string(word->name), .text = std::string(word->summary)});
  }
  return entries;
}

Entries ListSkills(const domain::ModelPath&) { return ListWords(execution::SkillWords()); }
Entries ListPredicates(const domain::ModelPath&) {
  Entries entries = ListWords(execution::PredicateWords());
  for (Entry& quantity : ListWords(execution::QuantityWords()))
    entries.push_back(std::move(quantity));
  return entries;
}

struct Kind {
  const char* name;
  Entries (*list)(const domain::ModelPath& models);
};
constexpr std::array kKinds = {Kind{"scenarios", ListScenarios}, Kind{"parts", ListParts},
                               Kind{"workcells", ListWorkcells}, Kind{"actions", ListActions},
                               Kind{"skills", ListSkills},       Kind{"meanings", ListPredicates}};

std::string ForPeople(const char* kind, const Entries& entries) {
  Table table({{kind}, {""}});
  for (const Entry& entry : entries) {
    table.Add({entry.name, entry.error.empty() ? entry.text : "cannot be read: " + entry.error});
  }
  return table.Text();
}

ExitCode Execute(const Options& options) {
  const domain::ModelPath models = FindModelsHere(options.models);
  Json json;
  std::string text;
  for (const Kind& kind : kKinds) {
    if (!options.kind.empty() && options.kind != kind.name) continue;
    const Entries entries = kind.list(models);
    json[kind.name] = Json::array();
    for (const Entry& entry : entries) {
      Json row = {{"name", entry.name}, {"text", entry.text}};
      if (!entry.error.empty()) row["error"] = entry.error;
      json[kind.name].push_back(std::move(row));
    }
    text += (text.empty() ? "" : "\n") + ForPeople(kind.name, entries);
  }
  Print(options.json ? plan::JsonText(json) : text);
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.push_back(kind.name);
  command.add_option("kind", options->kind, "list only these")->check(CLI::IsMember(names));
  command.add_flag("--json", options->json, "print as JSON");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace list_verb

const Verb kList = {
    .name = "list",
    .summary =
        "lists scenarios, parts, workcells, actions, and the skills and meanings for the key "
        "knowledge of scenarios",
    .page = "scenarios/README.md",
    .example = "assay list scenarios",
    .declare = list_verb::Declare,
};

}  // namespace assay::cli
