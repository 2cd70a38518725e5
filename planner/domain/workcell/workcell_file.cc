#include "planner/domain/workcell/workcell_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "planner/domain/workcell/robot_file.h"
#include "planner/domain/workcell/uncertainty_operations_file.h"

namespace assay::domain {
namespace {

using geometry::Vector2;

constexpr double kPi = std::numbers::pi;
constexpr int kMostPlacesAcross = 100;  // greatest number along x or y

struct Rule {
  const char* key;
  double WorkcellRules::*member;
  Dimension dimension;
  Range range;  // in SI
};

// Ranges are tight, because a value outside of its range is probably given in a wrong unit. For
// example, approach directions are not finer than 5 degrees. The contact allowance is at most what
// a success tolerates beyond the clearance (mating_success.h).
constexpr std::array<Rule, 12> kRules = {{
    {"tool_lean", &WorkcellRules::tool_lean, Dimension::kAngle, {0, kPi / 2}},
    {"approach_step", &WorkcellRules::approach_step, Dimension::kAngle, {kPi / 36, kPi / 2}},
    {"approach_distance", &WorkcellRules::approach_distance, Dimension::kLength, {0.001, 0.5}},
    {"safe_height", &WorkcellRules::safe_height, Dimension::kLength, {0.01, 2}},
    {"friction", &WorkcellRules::friction, Dimension::kRatio, {0, 10}},
    {"pad_friction", &WorkcellRules::pad_friction, Dimension::kRatio, {0, 10}},
    {"grip_force", &WorkcellRules::grip_force, Dimension::kForce, {0.1, 1000}},
    {"part_gap", &WorkcellRules::part_gap, Dimension::kLength, {0, 0.5}},
    {"contact_allowance", &WorkcellRules::contact_allowance, Dimension::kLength, {0, 0.0002}},
    {"pad_margin", &WorkcellRules::pad_margin, Dimension::kLength, {0, 0.01}},
    {"guarded_travel", &WorkcellRules::guarded_travel, Dimension::kLength, {0, 0.05}},
    {"lateral_compliance", &WorkcellRules::lateral_compliance, Dimension::kLength, {0, 0.05}},
}};

Unit UnitIn(const Units& units, Dimension dimension) {
  if (dimension == Dimension::kLength) return units.length;
  return dimension == Dimension::kAngle ? units.angle : SiUnitOf(dimension);
}

const std::vector<std::string>& RuleNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> keys;
    for (const Rule& rule : kRules) keys.emplace_back(rule.key);
    return keys;
  }();
  return names;
}

Range ReadRange(const Value& value, const Units& units) {
  const Vector2 ends = ReadVector2(value, units);
  if (ends.x() > ends.y()) {
    value.Fail(fmt::format("the range goes down, from {} to {}", InUnit(ends.x(), units.length),
                           InUnit(ends.y(), units.length)),
               "[low, high]");
  }
  return {ends.x(), ends.y()};
}

// Returns low, low + step, ... up to high. A step that meets `high`, apart from rounding, is
// counted.
std::vector<double> Steps(const Value& place, const Range& range, double step) {
  const double count = std::floor((range.high - range.low) / step + 1e-9) + 1;
  if (count > kMostPlacesAcross) {
    place.Fail(fmt::format("{} places from one end to the other", count),
               fmt::format("at most {}", kMostPlacesAcross));
  }
  std::vector<double> steps;
  for (int i = 0; i < static_cast<int>(count); ++i) steps.push_back(range.low + i * step);
  return steps;
}

// Sorts places by distance, nearest first. Distances are rounded, so that places at equal distance
// from the preferred point compare equal on every machine. Equal places are sorted by x and y.
void SortByDistance(std::vector<Vector2>& places, const Vector2& preferred) {
  const auto key = [&](const Vector2& p) {
    return std::tuple(std::round((p - preferred).norm() * 1e9), p.x(), p.y());
  };
  std::ranges::sort(places, [&](const Vector2& a, const Vector2& b) { return key(a) < key(b); });
}

}  // namespace

WorkcellRules ReadRules(const Value& map, const Units& units, const kinematics::Gripper& gripper,
                        const WorkcellRules& given) {
  WorkcellRules rules = given;
  for (const auto& [key, value] : map.Entries()) {
    const Rule& rule = kRules[static_cast<std::size_t>(key.OneOf(RuleNames()))];
    Range range = rule.range;
    if (rule.member == &WorkcellRules::grip_force)
      range.high = std::min(range.high, gripper.max_force());
    rules.*rule.member = ReadWithin(value, UnitIn(units, rule.dimension), range);
  }
  return rules;
}

std::shared_ptr<const Workcell> WorkcellFile::Read(const std::filesystem::path& file) {
  return WorkcellFile(file).workcell_;
}

WorkcellFile::WorkcellFile(const std::filesystem::path& file)
    : folder_(file.parent_path()), workcell_(new Workcell) {
  const Document document = Document::Load(file);
  document.RequireFormat("assay-workcell/1");
  const Value& root = document.root();
  root.AllowOnly({"format", "description", "units", "robot", "robots", "gripper", "table", "tables",
                  "rules", "placements", "places", "sensors", "verifications", "recoveries"});
  if (const auto description = root.Find("description")) description->Text();
  units_ = ReadUnits(root);
  workcell_->name_ = folder_.filename().string();
  workcell_->robots_ = ReadRobots(root, units_, folder_);
  ReadTables(root);
  ReadAllRules(root.At("rules"));
  ReadPlacements(root.At("placements"));
  if (const auto places = root.Find("places")) ReadPlaces(*places);
  workcell_->uncertainty_operations_ = ReadUncertaintyOperations(root, units_);
}

void WorkcellFile::ReadTables(const Value& root) {
  const std::optional<Value> tables = root.Find("tables");
  if (!tables) return ReadTable("table", root.At("table"));
  if (const auto table = root.Find("table")) {
    table->Fail("both table and tables", "one of the two");
  }
  if (tables->Entries().empty()) tables->Fail("there are no tables", "at least one");
  for (const auto& [name, table] : tables->Entries()) {
    const auto is_same = [&](const Table& other) { return other.name == name.Text(); };
    if (std::ranges::any_of(workcell_->tables_, is_same)) {
      name.Fail(fmt::format("'{}' is given twice", name.Text()), "each table once");
    }
    ReadTable(name.Text(), table);
  }
}

void WorkcellFile::ReadTable(const std::string& name, const Value& table) {
  table.AllowOnly({"x", "y", "thickness"});
  const Range x = ReadRange(table.At("x"), units_);
  const Range y = ReadRange(table.At("y"), units_);
  if (x.low == x.high || y.low == y.high) table.Fail("the table has no area");
  workcell_->tables_.push_back(
      {.name = name,
       .top = {{x.low, y.low}, {x.high, y.low}, {x.high, y.high}, {x.low, y.high}},
       .thickness = ReadWithin(table.At("thickness"), units_.length, {0.001, 1})});
}

void WorkcellFile::ReadAllRules(const Value& rules) {
  for (const std::string& name : RuleNames()) rules.At(name);
  workcell_->rules_ = ReadRules(rules, units_, workcell_->gripper(), {});
}

void WorkcellFile::ReadPlacements(const Value& placements) {
  placements.AllowOnly({"x", "y", "step", "yaws", "nearest_to"});
  const double step = ReadWithin(placements.At("step"), units_.length, {0.001, 10});
  const Value x = placements.At("x");
  const Value y = placements.At("y");
  std::vector<Vector2> places;
  const std::vector<double> ys = Steps(y, ReadRange(y, units_), step);
  for (const double px : Steps(x, ReadRange(x, units_), step)) {
    for (const double py : ys) places.emplace_back(px, py);
  }
  SortByDistance(places, ReadVector2(placements.At("nearest_to"), units_));
  const int yaws = placements.At("yaws").Integer(1, 72);
  for (const Vector2& p : places) {
    for (int i = 0; i < yaws; ++i) {
      workcell_->placements_.push_back({p.x(), p.y(), 2 * kPi * i / yaws});
    }
  }
}

void WorkcellFile::ReadPlaces(const Value& places) {
  for (const auto& [name, entry] : places.Entries()) {
    entry.AllowOnly({"at", "yaw", "radius", "room"});
    const auto is_same = [&](const Place& other) { return other.name == name.Text(); };
    if (std::ranges::any_of(workcell_->places_, is_same)) {
      name.Fail(fmt::format("'{}' is given twice", name.Text()), "each place once");
    }
    const Vector2 at = ReadVector2(entry.At("at"), units_);
    const auto yaw = entry.Find("yaw");
    const auto room = entry.Find("room");
    workcell_->places_.push_back(
        {.name = name.Text(),
         .middle = {at.x(), at.y(), yaw ? ReadAngle(*yaw, units_) : 0},
         .radius = ReadWithin(entry.At("radius"), units_.length, {0.001, 10}),
         .room = room ? room->Integer(1, 100) : 1});
  }
}

}  // namespace assay::domain
