#include "planner/domain/matings/seat.h"

#include <algorithm>
#include <cmath>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

constexpr double kStep = 2e-5;            // metres; a seat is no thinner than this
constexpr double kExact = 1e-6;           // metres
constexpr double kRoundedOverlap = 1e-6;  // overlap of parts that touch, metres

}  // namespace

std::optional<double> WayToSeat(const PartModel& held, const PartModel& fixed,
                                const Pose& X_FixedHeld, const Vector3& direction,
                                double farthest) {
  const auto meet = [&](double way) {
    return Overlaps(held.shape(), geometry::Translation(way * direction) * X_FixedHeld,
                    fixed.shape(), Pose::Identity(), kRoundedOverlap);
  };
  const double to_table = FarthestAlong(fixed.pieces(), direction) -
                          FarthestAlong(Transformed(held.pieces(), X_FixedHeld), direction);
  const double longest = std::min(to_table, farthest);
  double free = 0;
  if (meet(free)) return 0;
  double met = kStep;
  while (met < longest && !meet(met)) {
    free = met;
    met += kStep;
  }
  if (met >= longest) {
    return std::abs(to_table) <= farthest ? std::optional(to_table) : std::nullopt;
  }
  while (met - free > kExact) {
    const double middle = (free + met) / 2;
    (meet(middle) ? met : free) = middle;
  }
  return free;
}

}  // namespace assay::domain
