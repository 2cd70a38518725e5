#include "sim/execution/interpretation/knowledge_scenario.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <stdexcept>

#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "planner/motion/handling/part_reach.h"
#include "sim/execution/interpretation/plan_interpretation.h"

namespace assay::execution {
namespace {

constexpr domain::Range kSpillTilts = {std::numbers::pi / 18000, std::numbers::pi};

// Reads the key `knowledge` of a scenario file.
class KnowledgeFile {
 public:
  KnowledgeFile(const Value& root, const domain::Problem& problem)
      : map_(root.At("knowledge")), problem_(problem), units_(domain::ReadUnits(root)) {
    map_.AllowOnly(
        {"domain", "problem", "externs", "colors", "actions", "predicates", "hidden", "spills"});
    const contingent::Task task =
        contingent::LoadTask(Beside(map_.At("domain")), Beside(map_.At("problem")));
    for (const contingent::Action& action : task.domain.actions) actions_.push_back(action.name);
    for (const contingent::Symbol& p : task.domain.predicates) predicates_.push_back(p.name);
    for (const contingent::Symbol& f : task.domain.functions) {
      predicates_.push_back(f.name);
      if (f.range == contingent::kNumberType) numbers_.insert(f.name);
    }
    for (const contingent::Symbol& e : task.domain.externs) externs_.push_back(e.name);
    contingent::Externs externs;
    if (const auto bound = map_.Find("externs")) BindExterns(*bound, externs);
    if (const auto colors = map_.Find("colors")) ReadColors(*colors);
    read_.task =
        contingent::Ground(task.domain, task.problem, externs, contingent::KnownFacts::kAll);
    ReadActions(map_.At("actions"));
    ReadPredicates(map_.At("predicates"));
    if (const auto hidden = map_.Find("hidden")) {
      read_.hidden = ReadHiddenParts(*hidden, problem, read_.colors);
    }
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

  // Binds the externs of a map like {isReachable: reachable}.
  void BindExterns(const Value& map, contingent::Externs& externs) {
    for (const auto& [name, word] : map.Entries()) {
      name.OneOf(externs_);
      word.OneOf({"reachable"});
      externs.Add(name.Text(), [this](std::span<const std::string> arguments) {
        return CanBeReached(RolesOf(problem_, arguments),
                            fmt::format("{}", fmt::join(arguments, ", ")));
      });
    }
  }

  // Returns whether the robot of the arguments can reach every part at the middle of the place, in
  // the stable pose that the part has at the start.
  bool CanBeReached(const Roles& roles, const std::string& arguments) {
    if (roles.place == nullptr)
      throw std::invalid_argument("this extern needs a place among its arguments");
    const domain::Problem problem =
        roles.robot.IsNone() ? problem_ : domain::WorkedBy(problem_, roles.robot);
    for (std::size_t i = 0; i < problem.parts.size(); ++i) {
      const domain::Part& part = problem.parts[i];
      const geometry::Pose X_WorldPart =
          roles.place->middle.X_WorldTable() *
          part.model->stable_poses()[part.resting.index()].X_TablePart;
      if (!motion::ServingGrasp(problem, PartId(i), X_WorldPart).IsNone()) continue;
      read_.unserved.push_back(fmt::format("{} ({}): {}", part.name, arguments,
                                           motion::WhyNotServed(problem, PartId(i), X_WorldPart)));
      return false;
    }
    return true;
  }

  void ReadColors(const Value& map) {
    for (const auto& [name, value] : map.Entries()) {
      const std::vector<double> rgb = value.Numbers(3);
      const sense::NamedColor named = {name.Text(), {rgb[0], rgb[1], rgb[2]}};
      const sense::ColorFilter filter(named.color);
      if (!filter.HasHue()) value.Fail("a colour that is too grey to tell", "one with a hue");
      for (const sense::NamedColor& other : read_.colors) {
        if (filter.Overlaps(sense::ColorFilter(other.color))) {
          value.Fail(fmt::format("the colour is like '{}'", other.name),
                     "colours unlike each other");
        }
      }
      read_.colors.push_back(named);
    }
  }

  void ReadActions(const Value& map) {
    std::map<std::string, Value> places;
    for (const auto& [name, entry] : map.Entries()) {
      name.OneOf(actions_);
      const bool is_new = places.emplace(name.Text(), entry).second;
      if (!is_new) name.Fail(fmt::format("'{}' is given twice", name.Text()), "once");
      read_.skills[name.Text()] = ReadSkill(entry, {problem_, units_, read_.colors});
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
      if (numbers_.contains(name.Text())) {
        read_.quantities[name.Text()] = ReadQuantity(entry);
      } else {
        read_.predicates[name.Text()] = ReadPredicate(entry, {problem_, read_.colors});
      }
    }
    for (const contingent::GroundAtom& atom : read_.task.ground_atoms) {
      const Value& place = MeaningAt(map, places, atom.symbol);
      RequireMeaning(place, read_.predicates[atom.symbol].get(), atom.symbol, atom.arguments);
    }
    for (const contingent::FunctionId id : read_.task.function_of_slot) {
      const contingent::GroundFunction& function = read_.task.functions[id.index()];
      const Value& place = MeaningAt(map, places, function.symbol);
      RequireMeaning(place, read_.QuantityOf(id), function.symbol, function.arguments);
    }
    RequireSensible(places);
  }

  static const Value& MeaningAt(const Value& map, const std::map<std::string, Value>& places,
                                const std::string& symbol) {
    const auto place = places.find(symbol);
    if (place == places.end()) {
      map.Fail(fmt::format("the domain's '{}' has no meaning", symbol), symbol + ": {is: ...}");
    }
    return place->second;
  }

  void RequireMeaning(const Value& place, const auto* meaning, const std::string& symbol,
                      const std::vector<std::string>& arguments) const {
    if (meaning == nullptr) return;
    RequireRoles(place, symbol, arguments, meaning->Lacks(RolesOf(problem_, arguments)));
  }

  // Readings decide the branches of a plan, so each formula that is sensed needs a sensor.
  void RequireSensible(const std::map<std::string, Value>& places) const {
    for (const contingent::FormulaId id : contingent::SensedFormulas(read_.task)) {
      const contingent::Formula& formula = read_.task.formulas[id.index()];
      if (IsObservable(formula)) continue;
      const std::string& symbol =
          formula.bound ? read_.task.functions[formula.bound->function.index()].symbol
                        : read_.task.ground_atoms[formula.literals.front().atom.index()].symbol;
      places.at(symbol).Fail(
          fmt::format("no sensor tells whether {}", TextOf(read_.task, formula)),
          formula.bound ? "a quantity of the workcell" : "a meaning that sensors tell");
    }
  }

  // One observed literal suffices, because the other literals may be known when it is sensed.
  bool IsObservable(const contingent::Formula& formula) const {
    if (formula.bound) return read_.QuantityOf(formula.bound->function) != nullptr;
    return std::ranges::any_of(formula.literals, [&](const contingent::GroundLiteral& literal) {
      return read_.IsObservable(literal.atom);
    });
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
    if (read_.predicates[predicate.Text()] == nullptr) {
      predicate.Fail(fmt::format("'{}' has no meaning in the workcell", predicate.Text()),
                     "a predicate with one");
    }
    RequireMeaningOfParts(predicate);
    read_.spill = {predicate.Text(),
                   domain::ReadWithin(map.At("beyond"), units_.angle, kSpillTilts)};
  }

  // The predicate for spilling is evaluated for each part alone, without further arguments.
  void RequireMeaningOfParts(const Value& predicate) const {
    const Predicate& meaning = *read_.predicates.at(predicate.Text());
    for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
      const std::string lacking = meaning.Lacks({.part = PartId(i)});
      if (lacking.empty()) continue;
      predicate.Fail(fmt::format("'{}' needs a {} beside the part", predicate.Text(), lacking),
                     "a predicate that means something of a part alone");
    }
  }

  Value map_;
  const domain::Problem& problem_;
  domain::Units units_;
  std::vector<std::string> actions_;
  std::vector<std::string> predicates_;
  std::set<std::string> numbers_;  // numeric functions, which are in predicates_, too
  std::vector<std::string> externs_;
  Interpretation read_;
};

// Reads a scenario without the key `knowledge`. Its knowledge concerns the open poses, and whether
// steps of its plans pass their verifications.
KnowledgeScenario ReadPlanned(const Document& document, const domain::ModelPath& models,
                              const WorldPlanning& planning) {
  auto planned = std::make_shared<PlannedWorlds>();
  planned->worlds = domain::ReadWorlds(document, models, planning.overrides);
  planned->assembly =
      assembly::MakeContingentPlan(planned->worlds, planning.planner, planning.uncertainty);
  scenario::Overrides first = planning.overrides;
  for (const domain::OpenPose& open : planned->worlds.front().open_poses) {
    first.poses[planned->worlds.front().part(open.part).name] = 0;
  }
  KnowledgeScenario loaded{.scenario = scenario::Read(document, models, first),
                           .interpretation = {}};
  loaded.interpretation = InterpretationOf(std::move(planned));
  return loaded;
}

}  // namespace

KnowledgeScenario Read(const Document& document, const domain::ModelPath& models,
                       const WorldPlanning& planning) {
  document.RequireFormat("assay-scenario/1");
  if (!document.root().Find("knowledge")) return ReadPlanned(document, models, planning);
  KnowledgeScenario loaded{.scenario = scenario::Read(document, models, planning.overrides),
                           .interpretation = {}};
  loaded.interpretation = KnowledgeFile(document.root(), loaded.scenario.problem).Take();
  return loaded;
}

KnowledgeScenario Load(const std::filesystem::path& file, const domain::ModelPath& models) {
  return Read(Document::Load(file), models);
}

bool NeedsATree(const Document& scenario) {
  if (scenario.root().Find("knowledge")) return true;
  const std::optional<Value> parts = scenario.root().Find("parts");
  if (!parts) return false;
  return std::ranges::any_of(parts->Entries(), [](const auto& entry) {
    const std::optional<Value> pose = entry.second.Find("pose");
    return pose && pose->Find("one-of");
  });
}

}  // namespace assay::execution
