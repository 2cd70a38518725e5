#include "sim/sweep/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "planner/domain/units.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

constexpr int kMostTrials = 10'000'000;           // of a cell
constexpr domain::Range kClearances = {0, 0.01};  // metres
constexpr domain::Range kErrorScales = {0, 100};
constexpr int kLargestBudget = std::numeric_limits<int>::max();

// The values of an axis, each once; those of `axis` if the key is left out.
template <class T, class Read>
void ReadAxis(const Value& root, const char* key, std::vector<T>& axis, const Read& read) {
  const std::optional<Value> list = root.Find(key);
  if (!list) return;
  axis.clear();
  for (const Value& item : list->Items()) {
    const T value = read(item);
    if (std::ranges::find(axis, value) != axis.end()) {
      item.Fail("the value is given twice", "each value once");
    }
    axis.push_back(value);
  }
  if (axis.empty()) list->Fail("the list is empty", "one value or more");
}

// Values with names, in the order of their enumeration.
template <class Enum>
auto Named(const std::vector<std::string>& names) {
  return [&names](const Value& value) { return static_cast<Enum>(value.OneOf(names)); };
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
  ReadAxis(root, "error_scales", sweep.error_scales,
           [](const Value& value) { return domain::ReadWithin(value, 1, kErrorScales); });
  ReadAxis(root, "propagation", sweep.propagations,
           Named<uncertainty::Propagation>(PropagationNames()));
  ReadAxis(root, "grasp", sweep.grasps, Named<scene::GraspMode>(GraspNames()));
  ReadAxis(root, "sensing", sweep.sensings, Named<Sensing>(SensingNames()));
  ReadAxis(root, "noise", sweep.noises, Named<noise::Mode>(noise::ModeNames()));
  ReadAxis(root, "seeds", sweep.seeds, [](const Value& value) {
    return static_cast<std::uint64_t>(value.Integer(0, std::numeric_limits<int>::max()));
  });
}

void CheckSize(const Value& root, const Sweep& sweep) {
  // Axes are short; their product need not be.
  double trials = std::max(sweep.trials, sweep.control_trials);
  for (const std::size_t length :
       {sweep.scenarios.size(), sweep.clearances.size(), sweep.error_scales.size(),
        sweep.propagations.size(), sweep.grasps.size(), sweep.sensings.size(), sweep.noises.size(),
        sweep.seeds.size()}) {
    trials *= static_cast<double>(length);
  }
  if (trials <= 100.0 * kMostTrials) return;
  root.Fail(fmt::format("the grid has {} trials", trials),
            fmt::format("{} at most", 100LL * kMostTrials));
}

std::string TextOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

const std::vector<std::string>& SensingNames() {
  static const std::vector<std::string> kNames = {"drawn", "camera"};
  return kNames;
}

const std::vector<std::string>& PropagationNames() {
  static const std::vector<std::string> kNames = {"paper", "sound"};
  return kNames;
}

const std::vector<std::string>& GraspNames() {
  static const std::vector<std::string> kNames = {"friction", "weld"};
  return kNames;
}

std::string_view Name(Sensing sensing) { return SensingNames()[static_cast<std::size_t>(sensing)]; }
std::string_view Name(uncertainty::Propagation propagation) {
  return PropagationNames()[static_cast<std::size_t>(propagation)];
}
std::string_view Name(scene::GraspMode grasp) {
  return GraspNames()[static_cast<std::size_t>(grasp)];
}

fs::path Sweep::PathOf(const std::string& scenario) const {
  return (file.parent_path() / scenario).lexically_normal();
}

Sweep ReadSweep(const Document& document, const fs::path& file, std::string text) {
  document.RequireFormat("assay-sweep/1");
  const Value& root = document.root();
  root.AllowOnly({"format", "title", "units", "scenarios", "clearances", "error_scales",
                  "propagation", "grasp", "sensing", "noise", "seeds", "trials", "control_trials",
                  "planner"});
  Sweep sweep{.file = file, .text = std::move(text)};
  if (const auto title = root.Find("title")) sweep.title = title->Text();
  root.At("scenarios");
  ReadAxes(root, sweep);
  sweep.trials = root.At("trials").Integer(1, kMostTrials);
  if (const auto trials = root.Find("control_trials")) {
    sweep.control_trials = trials->Integer(1, kMostTrials);
  }
  ReadPlanner(root, sweep);
  CheckSize(root, sweep);
  return sweep;
}

Sweep Load(const fs::path& file) { return ReadSweep(Document::Load(file), file, TextOf(file)); }

}  // namespace assay::sweep
