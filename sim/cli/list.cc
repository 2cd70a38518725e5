#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "planner/base/document.h"
#include "planner/domain/action_template.h"
#include "sim/cli/console.h"
#include "sim/cli/models_folder.h"
#include "sim/cli/table.h"
#include "sim/cli/verb.h"
#include "sim/enact/quantity.h"
#include "sim/enact/skill.h"

namespace assay::cli {
namespace list_verb {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Options {
  std::string kind;  // empty: all
  fs::path models;
  bool json = false;
};

struct Entry {
  std::string name;
  std::string text;  // one line
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

Entries ListScenarios(const fs::path& models) {
  Entries entries;
  for (const fs::path& file : SortedContents(models.parent_path() / "scenarios")) {
    if (file.extension() != ".yaml") continue;
    entries.push_back({file.string(), TextAt(Document::Load(file), "title")});
  }
  return entries;
}

// The features in the part file's words.
Entries ListParts(const fs::path& models) {
  Entries entries;
  for (const fs::path& folder : SortedContents(models / "parts")) {
    if (!fs::exists(folder / "part.yaml")) continue;
    std::vector<std::string> features;
    const Document document = Document::Load(folder / "part.yaml");
    for (const auto& [number, feature] : document.root().At("features").Entries()) {
      if (const auto what = feature.Find("what")) features.push_back(what->Text());
    }
    entries.push_back({folder.filename().string(), fmt::format("{}", fmt::join(features, ", "))});
  }
  return entries;
}

// "sensors: overhead-camera", of a section that a workcell file may have.
std::string NamesIn(const Document& document, const char* section) {
  const std::optional<Value> value = document.root().Find(section);
  if (!value) return "";
  std::vector<std::string> names;
  for (const auto& [name, ignored] : value->Entries()) names.push_back(name.Text());
  return fmt::format("; {}: {}", section, fmt::join(names, ", "));
}

Entries ListWorkcells(const fs::path& models) {
  Entries entries;
  for (const fs::path& folder : SortedContents(models / "workcells")) {
    const fs::path file = folder / "workcell.yaml";
    if (!fs::exists(file)) continue;
    const Document document = Document::Load(file);
    std::string text = TextAt(document, "description");
    for (const char* section : {"sensors", "verifications", "recoveries"}) {
      text += NamesIn(document, section);
    }
    entries.push_back({folder.filename().string(), std::move(text)});
  }
  return entries;
}

Entries ListActions(const fs::path&) {
  Entries entries;
  for (const domain::ActionRule& rule : domain::ActionRules()) {
    entries.push_back({std::string(rule.name), std::string(rule.summary)});
  }
  return entries;
}

template <class Words>
Entries ListWords(const Words& words) {
  Entries entries;
  for (const auto* word : words) {
    entries.push_back({std::string(word->name), std::string(word->summary)});
  }
  return entries;
}

Entries ListSkills(const fs::path&) { return ListWords(enact::SkillWords()); }
Entries ListMeanings(const fs::path&) {
  Entries entries = ListWords(enact::MeaningWords());
  for (Entry& quantity : ListWords(enact::QuantityWords())) entries.push_back(std::move(quantity));
  return entries;
}

struct Kind {
  const char* name;
  Entries (*list)(const fs::path& models);
};
constexpr std::array kKinds = {Kind{"scenarios", ListScenarios}, Kind{"parts", ListParts},
                               Kind{"workcells", ListWorkcells}, Kind{"actions", ListActions},
                               Kind{"skills", ListSkills},       Kind{"meanings", ListMeanings}};

std::string ForPeople(const char* kind, const Entries& entries) {
  Table table({{kind}, {""}});
  for (const Entry& entry : entries) table.Add({entry.name, entry.text});
  return table.Text();
}

ExitCode Execute(const Options& options) {
  const fs::path models = FindModelsHere(options.models);
  Json json;
  std::string text;
  for (const Kind& kind : kKinds) {
    if (!options.kind.empty() && options.kind != kind.name) continue;
    const Entries entries = kind.list(models);
    json[kind.name] = Json::array();
    for (const Entry& entry : entries) {
      json[kind.name].push_back({{"name", entry.name}, {"text", entry.text}});
    }
    text += (text.empty() ? "" : "\n") + ForPeople(kind.name, entries);
  }
  Print(options.json ? json.dump(2) + "\n" : text);
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.push_back(kind.name);
  command.add_option("kind", options->kind, "only these")->check(CLI::IsMember(names));
  command.add_flag("--json", options->json, "print as JSON");
  command.add_option("--models", options->models, "folder with parts/ and workcells/")
      ->check(CLI::ExistingDirectory);
  return [options] { return Execute(*options); };
}

}  // namespace list_verb

const Verb kList = {
    .name = "list",
    .summary =
        "lists scenarios, parts, workcells, actions, and skills and meanings for key knowledge",
    .example = "assay list scenarios",
    .declare = list_verb::Declare,
};

}  // namespace assay::cli
