#include "sim/enact/hidden_world.h"

#include <fmt/format.h>

namespace assay::enact {
namespace {

constexpr Interval kMasses = {0.001, 10};  // kg

Interval ReadMass(const Value& value) {
  const std::vector<double> ends = value.Numbers(2);
  const Interval range = {ends[0], ends[1]};
  if (range.low > range.high || range.low < kMasses.low || range.high > kMasses.high) {
    value.Fail(fmt::format("[{}, {}] kg is no range of masses", range.low, range.high),
               fmt::format("[low, high] from {} to {} kg", kMasses.low, kMasses.high));
  }
  return range;
}

}  // namespace

HiddenMasses ReadHiddenMasses(const Value& map, const domain::Problem& problem) {
  std::vector<std::string> names;
  for (const domain::Part& part : problem.parts) names.push_back(part.name);
  HiddenMasses masses;
  for (const auto& [name, entry] : map.Entries()) {
    std::vector<Interval>& kinds = masses[PartId(name.OneOf(names))];
    if (!kinds.empty()) name.Fail(fmt::format("'{}' is given twice", name.Text()), "once");
    entry.AllowOnly({"mass"});
    const Value mass = entry.At("mass");
    for (const Value& kind : mass.Items()) kinds.push_back(ReadMass(kind));
    if (kinds.empty()) mass.Fail("no mass", "at least one range [low, high], kg");
  }
  return masses;
}

double DrawnMass(const std::vector<Interval>& kinds, RandomStream& random) {
  const Interval& kind = kinds[random.Index(static_cast<int>(kinds.size()))];
  return random.Uniform(kind.low, kind.high);
}

HiddenWorld DrawnWorld(const HiddenMasses& masses, RandomStream& random) {
  HiddenWorld world;
  for (const auto& [part, kinds] : masses) world.masses[part] = DrawnMass(kinds, random);
  return world;
}

}  // namespace assay::enact
