#include "planner/domain/problem/tolerances_file.h"

#include <fmt/format.h>

#include <set>

#include "planner/domain/parts/part_file.h"

namespace assay::domain {
namespace {

// A quantity that has a tolerance: its name, and its amount in metres or as a ratio. `unit` is the
// file's.
struct Quantity {
  std::string what;
  double amount = 0;
  Unit unit = kRatio;
};

double ReadHalfWidth(const Value& value, const Quantity& of) {
  const double half_width = value.Number() * of.unit.factor;
  if (half_width == 0 || (half_width > 0 && half_width < of.amount)) return half_width;
  value.Fail(fmt::format("{} is no tolerance of {}", Beside(value.Text(), of.unit), of.what),
             of.amount > 0 ? fmt::format("{} or more, less than {}", InUnit(0, of.unit),
                                         InUnit(of.amount, of.unit))
                           : InUnit(0, of.unit));
}

// Returns the least friction of mating surfaces: of the workcell's value and of each part's.
Quantity LeastFriction(const Problem& problem) {
  Quantity least = {"the friction of mating surfaces", problem.workcell->rules().friction};
  for (const Part& part : problem.parts) {
    if (part.model->friction() >= least.amount) continue;
    least = {fmt::format("the friction of part '{}'", part.name), part.model->friction()};
  }
  return least;
}

void RequireSoundPockets(const Problem& problem, double tolerance) {
  std::set<const PartModel*> known;
  for (const Part& part : problem.parts) {
    if (!known.insert(part.model.get()).second) continue;
    for (const double error : {-tolerance, tolerance}) {
      PartFile::WithClearance(*part.model, problem.clearance + error);
    }
  }
}

}  // namespace

Tolerances ReadTolerances(const Value& map, const Units& units, const Problem& problem) {
  map.AllowOnly({"clearance", "friction", "pad_friction"});
  Tolerances tolerances;
  if (const auto clearance = map.Find("clearance")) {
    tolerances.clearance =
        ReadHalfWidth(*clearance, {"the clearance", problem.clearance, units.length});
    if (tolerances.clearance > 0) RequireSoundPockets(problem, tolerances.clearance);
  }
  if (const auto friction = map.Find("friction")) {
    tolerances.friction = ReadHalfWidth(*friction, LeastFriction(problem));
  }
  if (const auto pad_friction = map.Find("pad_friction")) {
    tolerances.pad_friction = ReadHalfWidth(
        *pad_friction, {"the friction of the pads", problem.workcell->rules().pad_friction});
  }
  return tolerances;
}

}  // namespace assay::domain
