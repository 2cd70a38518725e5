#include "sim/sweep/grid/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "planner/base/check.h"
#include "planner/base/input_files/input_file.h"
#include "planner/domain/units/units.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string>& SensingNames() {
  static const std::vector<std::string> kNames = {"drawn", "camera"};
  return kNames;
}

const std::vector<std::string>& PropagationNames() {
  static const std::vector<std::string> kNames = {"paper", "sound"};
  return kNames;
}

// Return the names of all values, in the order of the enumeration.
const std::vector<std::string>& NoiseNames() {
  static const std::vector<std::string> kNames = {"none", "uniform", "vertices", "low-discrepancy",
                                                  "attack"};
  return kNames;
}

constexpr int kMostTrials = 10'000'000;           // trials of a cell
constexpr int kMostAttempts = 10'000'000;         // attempts of a falsification
constexpr domain::Range kClearances = {0, 0.01};  // metres
constexpr domain::Range kErrorScales = {0, 100};
constexpr int kLargestBudget = std::numeric_limits<int>::max();

// Reads a list of values, none of which may occur twice.
template <class T, class Read>
void ReadAxis(const Value& list, std::vector<T>& axis, const Read& read) {
  axis.clear();
  for (const Value& item : list.Items()) {
    const T value = read(item);
    if (std::ranges::find(axis, value) != axis.end()) {
      item.Fail("the value is given twice", "each value once");
    }
    axis.push_back(value);
  }
  if (axis.empty()) list.Fail("the list is empty", "one value or more");
}

// Reads an axis of the grid. The axis keeps its values if the key is missing.
template <class T, class Read>
void ReadAxis(const Value& root, const char* key, std::vector<T>& axis, const Read& read) {
  if (const std::optional<Value> list = root.Find(key)) ReadAxis(*list, axis, read);
}

// Returns a reader of enumeration values. The names must be in the order of the enumeration.
template <class Enum>
auto Named(const std::vector<std::string>& names) {
  return [&names](const Value& value) { return static_cast<Enum>(value.OneOf(names)); };
}

// Reads resolvers and sorts them by their enumeration.
Resolvers ReadResolvers(const Value& list) {
  Resolvers resolvers;
  ReadAxis(list, resolvers, Named<domain::ResolverKind>(domain::ResolverNames()));
  std::ranges::sort(resolvers);
  return resolvers;
}

std::string ReadScenario(const Value& value, const fs::path& folder) {
  std::string name = value.Text();
  std::error_code ignored;
  if (!fs::is_regular_file(folder / name, ignored)) {
    value.Fail(fmt::format("there is no file {}", (folder / name).lexically_normal().string()),
               "paths of scenario files, from the folder of this file");
  }
  return name;
}

void ReadPlanner(const Value& root, Sweep& sweep) {
  const std::optional<Value> planner = root.Find("planner");
  if (!planner) return;
  planner->AllowOnly({"budget", "instances"});
  if (const auto budget = planner->Find("budget")) {
    sweep.partial_plans = budget->Integer(1, kLargestBudget);
  }
  if (const auto instances = planner->Find("instances")) {
    sweep.instances = instances->Integer(1, kLargestBudget);
  }
}

void ReadAxes(const Value& root, Sweep& sweep) {
  const domain::Units units = domain::ReadUnits(root);
  ReadAxis(root, "scenarios", sweep.scenarios,
           [&](const Value& value) { return ReadScenario(value, sweep.file.parent_path()); });
  ReadAxis(root, "clearances", sweep.clearances, [&](const Value& value) -> std::optional<double> {
    return domain::ReadWithin(value, units.length, kClearances);
  });
  ReadAxis(root, "error_scales", sweep.error_scales, [](const Value& value) {
    return domain::ReadWithin(value, domain::kRatio, kErrorScales);
  });
  ReadAxis(root, "propagation", sweep.propagations,
           Named<uncertainty::Propagation>(PropagationNames()));
  ReadAxis(root, "resolvers", sweep.resolvers,
           [](const Value& value) -> std::optional<Resolvers> { return ReadResolvers(value); });
  ReadAxis(root, "grasp", sweep.grasps, Named<scene::GraspMode>(GraspNames()));
  ReadAxis(root, "sensing", sweep.sensings, Named<Sensing>(SensingNames()));
  ReadAxis(root, "noise", sweep.noises, Named<NoiseKind>(NoiseNames()));
  ReadAxis(root, "seeds", sweep.seeds, [](const Value& value) {
    return static_cast<std::uint64_t>(value.Integer(0, std::numeric_limits<int>::max()));
  });
}

bool HasFalsification(const Sweep& sweep) {
  return std::ranges::find(sweep.noises, NoiseKind::kFalsification) != sweep.noises.end();
}

void ReadTrials(const Value& root, Sweep& sweep) {
  const bool only_falsifications = HasFalsification(sweep) && sweep.noises.size() == 1;
  if (!only_falsifications || root.Find("trials")) {
    sweep.trials = root.At("trials").Integer(1, kMostTrials);
  }
  if (const auto trials = root.Find("control_trials")) {
    sweep.control_trials = trials->Integer(1, kMostTrials);
  }
}

// A falsification continues from saved states, which contain no camera.
void RequireDrawnSensing(const Value& root, const Sweep& sweep) {
  if (std::ranges::find(sweep.sensings, Sensing::kCamera) == sweep.sensings.end()) return;
  root.At("sensing").Fail("an attack has no camera",
                          "'drawn' alone where 'attack' is among the noise");
}

void ReadFalsification(const Value& root, Sweep& sweep) {
  for (const char* key : {"attempts", "conservatism"}) {
    const std::optional<Value> value = root.Find(key);
    if (value && !HasFalsification(sweep)) {
      value->Fail("nothing is attacked", "only where 'attack' is among the noise");
    }
  }
  if (const auto attempts = root.Find("attempts")) {
    sweep.attempts = attempts->Integer(1, kMostAttempts);
  }
  if (const auto conservatism = root.Find("conservatism")) {
    sweep.conservatism = conservatism->Flag();
  }
  if (HasFalsification(sweep)) RequireDrawnSensing(root, sweep);
}

void CheckSize(const Value& root, const Sweep& sweep) {
  // Axes are short, but their product can be large.
  double trials = std::max(sweep.trials, sweep.control_trials);
  for (const std::size_t length :
       {sweep.scenarios.size(), sweep.clearances.size(), sweep.error_scales.size(),
        sweep.propagations.size(), sweep.resolvers.size(), sweep.grasps.size(),
        sweep.sensings.size(), sweep.noises.size(), sweep.seeds.size()}) {
    trials *= static_cast<double>(length);
  }
  if (trials <= 100.0 * kMostTrials) return;
  root.Fail(fmt::format("the grid has {} trials", trials),
            fmt::format("{} at most", 100LL * kMostTrials));
}

}  // namespace

noise::Mode ModeOf(NoiseKind kind) {
  switch (kind) {
    case NoiseKind::kNone:
      return noise::Mode::kNone;
    case NoiseKind::kUniform:
      return noise::Mode::kUniform;
    case NoiseKind::kVertices:
      return noise::Mode::kVertices;
    case NoiseKind::kLowDiscrepancy:
      return noise::Mode::kLowDiscrepancy;
    case NoiseKind::kFalsification:
      break;
  }
  ASSAY_CHECK(false, "an attack chooses its errors itself");
  return noise::Mode::kNone;
}

const std::vector<std::string>& GraspNames() {
  static const std::vector<std::string> kNames = {"friction", "weld"};
  return kNames;
}

std::string_view Name(NoiseKind kind) { return NoiseNames()[static_cast<std::size_t>(kind)]; }

std::string_view Name(Sensing sensing) { return SensingNames()[static_cast<std::size_t>(sensing)]; }
std::string_view Name(uncertainty::Propagation propagation) {
  return PropagationNames()[static_cast<std::size_t>(propagation)];
}

std::string Name(const Resolvers& resolvers) {
  std::vector<std::string> names;
  for (const domain::ResolverKind kind : resolvers) {
    names.push_back(domain::ResolverNames()[static_cast<std::size_t>(kind)]);
  }
  return fmt::format("{}", fmt::join(names, ","));
}

fs::path Sweep::PathOf(const std::string& scenario) const {
  return (file.parent_path() / scenario).lexically_normal();
}

Sweep ReadSweep(const Document& document, const fs::path& file, std::string text) {
  document.RequireFormat("assay-sweep/1");
  const Value& root = document.root();
  root.AllowOnly({"format", "title", "units", "scenarios", "clearances", "error_scales",
                  "propagation", "resolvers", "grasp", "sensing", "noise", "seeds", "trials",
                  "control_trials", "attempts", "conservatism", "planner"});
  Sweep sweep{.file = file, .text = std::move(text)};
  if (const auto title = root.Find("title")) sweep.title = title->Text();
  root.At("scenarios");
  ReadAxes(root, sweep);
  ReadTrials(root, sweep);
  ReadFalsification(root, sweep);
  ReadPlanner(root, sweep);
  CheckSize(root, sweep);
  return sweep;
}

Sweep Load(const fs::path& file) {
  std::string text = ReadInput(file, "a YAML or JSON file that can be read");
  const Document document = Document::Parse(text, file.string());
  return ReadSweep(document, file, std::move(text));
}

}  // namespace assay::sweep
