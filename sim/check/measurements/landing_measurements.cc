#include <fmt/format.h>

#include <algorithm>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "sim/check/measurements/fit.h"
#include "sim/check/measurements/measurement.h"

namespace assay::check {
namespace {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// The part meets the table within the guarded travel.
std::vector<MeasuredMargin> LandingHeight(const MeasuredStep& step) {
  const execution::Snapshot* reached = step.events().reached;
  if (reached == nullptr) return {};
  const Pose& X_WorldPart = step.step().action.place.X_WorldPart;
  const double table = reached->table_heights[step.part().index()];
  return OfAll(
      MetOnGuardedWay(step, {.X_WorldExpected = X_WorldPart,
                             .X_WorldEnd = geometry::Translation(0, 0, table) * X_WorldPart,
                             .direction = -Vector3::UnitZ()}));
}

// Returns the vertices on which the part is to stand at its place. Others may hover so low over the
// table that only the plan tells them apart.
std::vector<Vector3> PlannedSupport(const domain::PartModel& model, const Pose& X_WorldPart) {
  constexpr double kLayer = 1e-6;  // metres
  const auto height = [&](const Vector3& vertex) { return (X_WorldPart * vertex).z(); };
  std::vector<Vector3> vertices = model.corners();
  const double lowest = height(*std::ranges::min_element(vertices, {}, height));
  std::erase_if(vertices, [&](const Vector3& v) { return height(v) > lowest + kLayer; });
  return vertices;
}

// Every vertex on which the part stands is on the table.
std::vector<MeasuredMargin> Footprint(const MeasuredStep& step) {
  const StepEvents& events = step.events();
  if (events.reached == nullptr || events.end == nullptr) return {};
  const domain::Part& part = step.problem().part(step.part());
  const Pose X_WorldPart = step.PartAt(*events.end);
  const double table = events.end->table_heights[step.part().index()];
  const geometry::Polygon& top =
      domain::TableUnder(*step.problem().workcell, part, X_WorldPart).top;
  double worst = kInfinity;
  for (const Vector3& vertex : PlannedSupport(*part.model, step.step().action.place.X_WorldPart)) {
    const Vector3 p = X_WorldPart * vertex;
    if (p.z() > table + kStandsOn) continue;
    for (std::size_t i = 0; i < top.size(); ++i) {
      const Vector2 edge = (top[(i + 1) % top.size()] - top[i]).normalized();
      const Vector2 from = p.head<2>() - top[i];
      worst = std::min(worst, edge.x() * from.y() - edge.y() * from.x());
    }
  }
  return OfAll(worst);
}

// The part does not touch other parts where it is let go.
std::vector<MeasuredMargin> NeighbourClear(const MeasuredStep& step) {
  const execution::Snapshot* reached = step.events().reached;
  if (reached == nullptr) return {};
  std::vector<MeasuredMargin> measured;
  for (std::size_t p = 0; p < step.problem().parts.size(); ++p) {
    if (domain::PartId(p) == step.part()) continue;
    const domain::Part& other = step.problem().parts[p];
    AddClearance(fmt::format("the part stays clear of {}", other.name),
                 geometry::Distance(step.shape(), step.PartAt(*reached), other.model->shape(),
                                    reached->parts[p].truth),
                 measured);
  }
  return measured;
}

}  // namespace

std::vector<Measurement> LandingMeasurements() {
  return {{plan::condition::kLandingHeight, LandingHeight},
          {plan::condition::kFootprint, Footprint},
          {plan::condition::kNeighbourClear, NeighbourClear},
          {plan::condition::kStanding},
          {plan::condition::kPressed}};
}

}  // namespace assay::check
