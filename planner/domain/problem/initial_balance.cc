#include "planner/domain/problem/initial_balance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/face_contact.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {
namespace {

double GreatestOf(const Interval& error) {
  return std::max(std::abs(error.low), std::abs(error.high));
}

// Returns the greatest horizontal displacement that the part's error gives to points on it.
double DisplacementOf(const Part& part, const std::vector<Vector3>& points_World) {
  double radius = 0;
  for (const Vector3& p : points_World) {
    radius = std::max(radius, (p - part.X_WorldPart.translation()).head<2>().norm());
  }
  return std::hypot(GreatestOf(part.error.x), GreatestOf(part.error.y)) +
         radius * GreatestOf(part.error.theta);
}

geometry::Polygon Shadow(const std::vector<Vector3>& points) {
  std::vector<Vector2> shadow;
  for (const Vector3& p : points) shadow.push_back(p.head<2>());
  return geometry::Hull2(shadow);
}

class InitialBalance {
 public:
  InitialBalance(const Problem& problem, const Units& units, const std::vector<Value>& entries)
      : problem_(problem), units_(units), entries_(entries) {}

  void Check() const {
    for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
      const PartId id(i);
      if (BaseOf(id) != id) continue;
      CheckRests(id);
      CheckRestsWithErrors(id);
      CheckAssemblyRests(id);
    }
  }

 private:
  // Returns the part at the end of the chain of parts with which this part is assembled.
  PartId BaseOf(PartId id) const {
    const auto mating = std::ranges::find(problem_.assembled, id,
                                          [&](MatingId m) { return problem_.mating(m).held; });
    return mating == problem_.assembled.end() ? id : BaseOf(problem_.mating(*mating).fixed);
  }

  std::vector<PartId> AssembledOn(PartId base) const {
    std::vector<PartId> parts;
    for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
      if (BaseOf(PartId(i)) == base) parts.push_back(PartId(i));
    }
    return parts;
  }

  void RefuseHeightErrors(PartId upper, PartId lower) const;
  std::vector<Vector2> Support(PartId id, const std::vector<PartId>& own) const;
  static double DepthOver(const std::vector<Vector2>& stands_on, const Vector2& center) {
    return geometry::Depth(geometry::Hull2(stands_on), center);
  }
  // Says why a part falls whose centre of mass is `inside` metres inside of what it stands on.
  std::string WhyItFalls(const Part& part, const std::vector<Vector2>& stands_on,
                         double inside) const;
  void CheckRests(PartId id) const;
  void CheckRestsWithErrors(PartId id) const;
  void CheckAssemblyRests(PartId base) const;

  const Value& EntryOf(PartId id) const { return entries_[id.index()]; }
  std::string InFileUnit(double metres) const { return InUnit(metres, units_.length); }

  const Problem& problem_;
  const Units& units_;
  const std::vector<Value>& entries_;
};

// Two tables whose heights differ would leave the upper part in the air, or in the lower part.
void InitialBalance::RefuseHeightErrors(PartId upper, PartId lower) const {
  for (const PartId id : {upper, lower}) {
    if (problem_.part(id).error.z == Interval{}) continue;
    EntryOf(upper).Fail(
        fmt::format("part '{}' stands on part '{}', and part '{}' has a height error",
                    problem_.part(upper).name, problem_.part(lower).name, problem_.part(id).name),
        "parts on each other without an error of z");
  }
}

// Returns the corners, seen from above, of the areas in which the part touches the table and all
// parts but its `own`.
std::vector<Vector2> InitialBalance::Support(PartId id, const std::vector<PartId>& own) const {
  const Part& part = problem_.part(id);
  std::vector<Vector3> corners = CornersOnTable(*part.model, part.X_WorldPart);
  for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
    if (std::ranges::count(own, PartId(i)) > 0) continue;
    const Part& other = problem_.parts[i];
    const std::vector<Vector3> on_other =
        CornersOfContact(*part.model, part.X_WorldPart, *other.model, other.X_WorldPart);
    if (!on_other.empty()) RefuseHeightErrors(id, PartId(i));
    std::ranges::copy(on_other, std::back_inserter(corners));
  }
  std::vector<Vector2> stands_on;
  for (const Vector3& corner : corners) stands_on.push_back(corner.head<2>());
  return stands_on;
}

std::string InitialBalance::WhyItFalls(const Part& part, const std::vector<Vector2>& stands_on,
                                       double inside) const {
  if (stands_on.empty()) {
    return fmt::format("stands on nothing: its lowest point is {} above the table",
                       InFileUnit(LowestPoint(part, part.X_WorldPart)));
  }
  if (inside > -kRounding) return "rolls: it touches what it stands on along one line only";
  return fmt::format("falls over: its centre of mass is {} beside what it stands on",
                     InFileUnit(-inside));
}

void InitialBalance::CheckRests(PartId id) const {
  const Part& part = problem_.part(id);
  const std::vector<Vector2> stands_on = Support(id, {id});
  const Vector2 center = (part.X_WorldPart * part.model->mass().center).head<2>();
  const double inside = DepthOver(stands_on, center);
  if (inside > kRounding) return;
  EntryOf(id).Fail(
      fmt::format("part '{}' {}", part.name, WhyItFalls(part, stands_on, inside)),
      "a pose in which it stands on the table or on other parts, or a mating of 'initially'");
}

// The area of contact of two parts is eroded by the greatest displacement of the parts against each
// other. In what remains of the area, the parts touch each other whatever their errors are. The
// corners of the part that stand on the table stay on it whatever the errors are. Therefore the
// part stands if its centre of mass is over the hull of the remaining areas and of these corners.
void InitialBalance::CheckRestsWithErrors(PartId id) const {
  const Part& part = problem_.part(id);
  std::vector<Vector2> stands_on;
  for (const Vector3& corner : CornersOnTable(*part.model, part.X_WorldPart)) {
    stands_on.push_back(corner.head<2>());
  }
  bool is_on_part = false;
  for (const Part& other : problem_.parts) {
    if (&other == &part) continue;
    for (const std::vector<Vector3>& area :
         AreasOfContact(*part.model, part.X_WorldPart, *other.model, other.X_WorldPart)) {
      is_on_part = true;
      const double moved = DisplacementOf(part, area) + DisplacementOf(other, area);
      if (!std::isfinite(moved)) return;  // nothing is known about a pose
      const geometry::Polygon eroded = geometry::Inset(Shadow(area), moved);
      stands_on.insert(stands_on.end(), eroded.begin(), eroded.end());
    }
  }
  const Vector2 center = (part.X_WorldPart * part.model->mass().center).head<2>();
  if (!is_on_part || DepthOver(stands_on, center) > 0) return;
  EntryOf(id).Fail(fmt::format("part '{}' may fall over: what it stands on does not surely bear "
                               "it, for the errors of their poses",
                               part.name),
                   "a place, and errors, for which its centre of mass is over what it stands on");
}

void InitialBalance::CheckAssemblyRests(PartId base) const {
  const std::vector<PartId> parts = AssembledOn(base);
  std::vector<Vector2> stands_on;
  std::vector<std::string> names;
  double mass = 0;
  Vector2 moment = Vector2::Zero();
  for (const PartId id : parts) {
    const Part& part = problem_.part(id);
    const geometry::MassProperties& own = part.model->mass();
    mass += own.mass;
    moment += own.mass * (part.X_WorldPart * own.center).head<2>();
    std::ranges::copy(Support(id, parts), std::back_inserter(stands_on));
    names.push_back("'" + part.name + "'");
  }
  if (parts.size() == 1) return;
  const double inside = DepthOver(stands_on, moment / mass);
  if (inside > 0) return;
  EntryOf(base).Fail(
      fmt::format("parts {}, which are assembled at the start, fall over: their common centre of "
                  "mass is {} beside what they stand on",
                  fmt::join(names, ", "), InFileUnit(-inside)),
      "a pose in which they stand");
}

}  // namespace

void CheckInitialBalance(const Problem& problem, const Units& units,
                         const std::vector<Value>& entries) {
  InitialBalance(problem, units, entries).Check();
}

}  // namespace assay::domain
