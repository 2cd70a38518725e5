#include "sim/execution/hidden_worlds/hidden_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "planner/geometry/pose.h"

namespace assay::execution {
namespace {

constexpr Interval kMasses = {0.001, 10};  // kg, the allowed masses

Interval ReadMass(const Value& value) {
  const std::vector<double> ends = value.Numbers(2);
  const Interval range = {ends[0], ends[1]};
  if (range.low > range.high || range.low < kMasses.low || range.high > kMasses.high) {
    value.Fail(fmt::format("[{}, {}] kg is no range of masses", range.low, range.high),
               fmt::format("[low, high] from {} kg to {} kg", kMasses.low, kMasses.high));
  }
  return range;
}

HiddenKinds ReadKinds(const Value& entry, const std::vector<sense::NamedColor>& colors) {
  entry.AllowOnly({"mass", "color"});
  HiddenKinds kinds;
  if (const auto mass = entry.Find("mass")) {
    for (const Value& kind : mass->Items()) kinds.masses.push_back(ReadMass(kind));
  }
  if (const auto color = entry.Find("color")) {
    for (const Value& kind : color->Items()) kinds.colors.push_back(ReadColorName(kind, colors));
  }
  if (kinds.masses.empty() && kinds.colors.empty()) {
    entry.Fail("nothing is hidden", "mass: at least one range [low, high], kg; or color: [names]");
  }
  return kinds;
}

}  // namespace

geometry::Pose Fault::After(const geometry::Pose& X_WorldPart) const {
  geometry::Pose after = geometry::RotationZ(turn) * X_WorldPart;
  after.translation() = X_WorldPart.translation() + way;
  return after;
}

std::string Fault::Text(const domain::Problem& problem) const {
  const std::string& name = problem.part(part).name;
  if (turn != 0) {
    return fmt::format("before {}: {} turned by {:.0f} degrees", action, name,
                       turn * 180 / std::numbers::pi);
  }
  return fmt::format("before {}: {} moved by ({:.1f}, {:.1f}, {:.1f}) mm", action, name,
                     1e3 * way.x(), 1e3 * way.y(), 1e3 * way.z());
}

HiddenParts ReadHiddenParts(const Value& map, const domain::Problem& problem,
                            const std::vector<sense::NamedColor>& colors) {
  std::vector<std::string> names;
  for (const domain::Part& part : problem.parts) names.push_back(part.name);
  HiddenParts parts;
  for (const auto& [name, entry] : map.Entries()) {
    const auto [kinds, is_new] = parts.try_emplace(PartId(name.OneOf(names)));
    if (!is_new) name.Fail(fmt::format("'{}' is given twice", name.Text()), "once");
    kinds->second = ReadKinds(entry, colors);
  }
  return parts;
}

void KeepMasses(const Interval& within, HiddenKinds& kinds) {
  for (Interval& range : kinds.masses) {
    range = {std::max(range.low, within.low), std::min(range.high, within.high)};
  }
  std::erase_if(kinds.masses, [](const Interval& range) { return range.low > range.high; });
}

sense::ColorId ReadColorName(const Value& name, const std::vector<sense::NamedColor>& colors) {
  std::vector<std::string> names;
  for (const sense::NamedColor& color : colors) names.push_back(color.name);
  if (names.empty()) name.Fail("there are no colours", "a key colors");
  return sense::ColorId(name.OneOf(names));
}

void DrawPart(PartId part, const HiddenKinds& kinds, RandomStream& random, HiddenWorld& world) {
  if (!kinds.masses.empty()) {
    const Interval& kind = kinds.masses[random.Index(static_cast<int>(kinds.masses.size()))];
    world.masses[part] = random.Uniform(kind.low, kind.high);
  }
  if (!kinds.colors.empty()) {
    world.colors[part] = kinds.colors[random.Index(static_cast<int>(kinds.colors.size()))];
  }
}

HiddenWorld DrawnWorld(const HiddenParts& parts, int worlds, RandomStream& random) {
  HiddenWorld world;
  if (worlds > 1) world.world = random.Index(worlds);
  for (const auto& [part, kinds] : parts) DrawPart(part, kinds, random, world);
  return world;
}

}  // namespace assay::execution
