#include "sim/enact/interpretation.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "planner/contingent/grounding.h"
#include "planner/contingent/task_file.h"

namespace assay::enact {
namespace {

constexpr domain::Range kTilts = {std::numbers::pi / 18000, std::numbers::pi};

// Reads the key `knowledge`.
class KnowledgeFile {
 public:
  KnowledgeFile(const Value& root, const domain::Problem& problem)
      : map_(root.At("knowledge")), problem_(problem), units_(domain::ReadUnits(root)) {
    map_.AllowOnly({"domain", "problem", "actions", "predicates", "hidden", "spills"});
    const contingent::Task task =
        contingent::LoadTask(Beside(map_.At("domain")), Beside(map_.At("problem")));
    for (const contingent::Action& action : task.domain.actions) actions_.push_back(action.name);
    for (const contingent::Symbol& p : task.domain.predicates) predicates_.push_back(p.name);
    for (const contingent::Symbol& f : task.domain.functions) predicates_.push_back(f.name);
    contingent::Externs externs;
    read_.task = contingent::Ground(task.domain, task.problem, externs);
    ReadActions(map_.At("actions"));
    ReadPredicates(map_.At("predicates"));
    if (const auto hidden = map_.Find("hidden")) read_.hidden = ReadHiddenMasses(*hidden, problem);
    if (const auto spills = map_.Find("spills")) ReadSpill(*spills);
  }

  Interpretation Take() { return std::move(read_); }

 private:
  std::filesystem::path Beside(const Value& path) const {
    const std::filesystem::path folder = std::filesystem::path(path.Place().file).parent_path();
    const std::filesystem::path file = (folder / path.Text()).lexically_normal();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
      path.Fail(fmt::format("there is no file '{}'", path.Text()),
                "a path from the scenario's folder");
    }
    return file;
  }

  void ReadActions(const Value& map) {
    std::map<std::string, Value> places;
    for (const auto& [name, entry] : map.Entries()) {
      name.OneOf(actions_);
      const bool is_new = places.emplace(name.Text(), entry).second;
      if (!is_new) name.Fail(fmt::format("'{}' is given twice", name.Text()), "once");
      read_.skills[name.Text()] = ReadSkill(entry, {problem_, units_});
    }
    for (const contingent::GroundAction& action : read_.task.actions) {
      const auto place = places.find(action.name);
      if (place == places.end()) {
        map.Fail(fmt::format("the domain's action '{}' has no skill", action.name),
                 action.name + ": {skill: ...}");
      }
      RequireRoles(place->second, TextOf(action), action.arguments,
                   read_.skills[action.name]->Lacks(RolesOf(problem_, action.arguments)));
    }
  }

  void ReadPredicates(const Value& map) {
    std::map<std::string, Value> places;
    for (const auto& [name, entry] : map.Entries()) {
      name.OneOf(predicates_);
      const bool is_new = places.emplace(name.Text(), entry).second;
      if (!is_new) name.Fail(fmt::format("'{}' is given twice", name.Text()), "once");
      read_.meanings[name.Text()] = ReadMeaning(entry, {problem_});
    }
    for (const contingent::GroundAtom& atom : read_.task.ground_atoms) {
      const auto place = places.find(atom.symbol);
      if (place == places.end()) {
        map.Fail(fmt::format("the domain's '{}' has no meaning", atom.symbol),
                 atom.symbol + ": {is: ...}");
      }
      const Meaning* meaning = read_.meanings[atom.symbol].get();
      if (meaning == nullptr) continue;
      RequireRoles(place->second, atom.symbol, atom.arguments,
                   meaning->Lacks(RolesOf(problem_, atom.arguments)));
    }
  }

  static void RequireRoles(const Value& place, const std::string& what,
                           const std::vector<std::string>& arguments, const std::string& lacking) {
    if (lacking.empty()) return;
    place.Fail(
        fmt::format("'{}' needs a {}, and none of its arguments ({}) is the name of one", what,
                    lacking, fmt::join(arguments, ", ")),
        fmt::format("objects of the problem that are named like the scenario's {}s", lacking));
  }

  void ReadSpill(const Value& map) {
    map.AllowOnly({"if", "beyond"});
    const Value predicate = map.At("if");
    predicate.OneOf(predicates_);
    if (read_.meanings[predicate.Text()] == nullptr) {
      predicate.Fail(fmt::format("'{}' has no meaning in the workcell", predicate.Text()),
                     "a predicate with one");
    }
    read_.spill = {predicate.Text(), domain::ReadWithin(map.At("beyond"), units_.angle, kTilts)};
  }

  Value map_;
  const domain::Problem& problem_;
  domain::Units units_;
  std::vector<std::string> actions_;
  std::vector<std::string> predicates_;
  Interpretation read_;
};

}  // namespace

const Meaning* Interpretation::MeaningOf(contingent::AtomId atom) const {
  return meanings.at(task.ground_atoms[atom.index()].symbol).get();
}

bool Interpretation::CanSpill(const Truth& truth, PartId part) const {
  return spill && meanings.at(spill->predicate)->IsTrue(truth, {.part = part});
}

KnowledgeScenario Load(const std::filesystem::path& file, const std::filesystem::path& models) {
  const Document document = Document::Load(file);
  document.RequireFormat("assay-scenario/1");
  KnowledgeScenario loaded{.scenario = scenario::Load(file, models), .interpretation = {}};
  loaded.interpretation = KnowledgeFile(document.root(), loaded.scenario.problem).Take();
  return loaded;
}

}  // namespace assay::enact
