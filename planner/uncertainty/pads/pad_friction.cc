#include "planner/uncertainty/pads/pad_friction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace assay::uncertainty {
namespace {

constexpr double kNowhere = 1e-12;  // metres: a cell so near to the pivot does not move
// Distances from the centre of friction to the points about which the part may turn between the
// pads. The unit is the mean distance of the pads' friction from this centre (reach_).
constexpr std::array kPivots = {0.0, 0.15, 0.3, 0.5, 0.75, 1.0, 1.4, 2.0, 3.5, 8.0};

Vector2 QuarterTurn(const Vector2& v) { return {-v.y(), v.x()}; }

double Cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

PadFriction::PadFriction(std::vector<PadCell> cells) : cells_(std::move(cells)) {
  for (const PadCell& cell : cells_) {
    friction_ += cell.friction;
    center_ += cell.friction * cell.at;
  }
  if (!(friction_ > 0)) return;
  center_ /= friction_;
  for (PadCell& cell : cells_) {
    cell.at -= center_;
    reach_ += cell.friction * cell.at.norm() / friction_;
  }
}

// Each cell's friction acts along the direction in which the cell would move.
PadFriction::Node PadFriction::TurningAbout(double distance, const Vector2& along) const {
  const Vector2 pivot = distance * QuarterTurn(along);
  Vector2 force = Vector2::Zero();
  double torsion = 0;
  for (const PadCell& cell : cells_) {
    const Vector2 way = QuarterTurn(cell.at - pivot);
    const double length = way.norm();
    if (length < kNowhere) continue;
    const Vector2 friction = cell.friction / length * way;
    force += friction;
    torsion += Cross(cell.at, friction);
  }
  return {.force = force.dot(along), .aside = Cross(along, force), .torsion = torsion};
}

double PadFriction::RatioOf(const PlaneLoad& load) const {
  if (!(friction_ > 0)) return std::numeric_limits<double>::infinity();
  const double force = load.force.norm();
  const double sense =
      load.torsion < 0 ? -1 : 1;  // friction is symmetric: as seen from the other side
  const Vector2 along = force > 0 ? Vector2(sense * load.force / force) : Vector2::UnitX();
  const double torsion = std::abs(load.torsion);
  double least = std::numeric_limits<double>::infinity();
  Node nearer = TurningAbout(0, along);
  for (std::size_t i = 1; i <= kPivots.size(); ++i) {
    const bool is_last = i == kPivots.size();
    const Node farther =
        is_last ? Node{.force = friction_} : TurningAbout(kPivots[i] * reach_, along);
    // load = a * nearer + b * farther. The opposite of a load is borne as well.
    const double determinant = nearer.force * farther.torsion - farther.force * nearer.torsion;
    const double a = (force * farther.torsion - farther.force * torsion) / determinant;
    const double b = (nearer.force * torsion - force * nearer.torsion) / determinant;
    const double aside = std::abs(a * nearer.aside + b * farther.aside);
    least = std::min(least, std::abs(a) + std::abs(b) + aside / friction_);
    nearer = farther;
  }
  return least;
}

}  // namespace assay::uncertainty
