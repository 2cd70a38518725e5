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

// Returns a way on which parts are apart, up to kExact before one on which they meet.
template <class Meet>
double Apart(double apart, double met, const Meet& meet) {
  while (std::abs(met - apart) > kExact) {
    const double middle = (apart + met) / 2;
    (meet(middle) ? met : apart) = middle;
  }
  return apart;
}

// Returns the way, against the direction, after which parts that overlap are apart; 0 if they
// overlap everywhere.
template <class Meet>
double WayBack(double farthest, const Meet& meet) {
  double met = 0;
  for (double back = -kStep; back >= -farthest; met = back, back -= kStep) {
    if (!meet(back)) return Apart(back, met, meet) - kExact;
  }
  return 0;
}

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
  if (meet(free)) return WayBack(farthest, meet);
  double met = kStep;
  while (met < longest && !meet(met)) {
    free = met;
    met += kStep;
  }
  if (met >= longest) {
    return std::abs(to_table) <= farthest ? std::optional(to_table) : std::nullopt;
  }
  return Apart(free, met, meet);
}

}  // namespace assay::domain
