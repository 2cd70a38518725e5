#include "planner/uncertainty/pads/touching_cells.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "planner/uncertainty/pads/contact_patch.h"

#include "planner/geometry/polygon.h"

namespace assay::uncertainty {
namespace {

using geometry::Polygon;

// Divides a rectangle into cells, and returns those that satisfy the test.
TouchingCells Divided(const Vector2& middle, const Vector2& half,
                      const std::function<bool(const Vector2&, const Vector2&)>& touches) {
  TouchingCells cells{.middles = {}, .half = half / kCellsPerSide};
  for (int i = 0; i < kCellsPerSide; ++i) {
    for (int j = 0; j < kCellsPerSide; ++j) {
      const Vector2 at =
          middle + cells.half.cwiseProduct(2 * Vector2(i, j) + Vector2::Ones()) - half;
      if (touches(at, cells.half)) cells.middles.push_back(at);
    }
  }
  return cells;
}

TouchingCells CellsOfPatch(const geometry::Patches& patch) {
  const Eigen::AlignedBox2d bounds = BoundsOf(patch);
  return Divided(bounds.center(), bounds.sizes() / 2, [&](const Vector2& at, const Vector2& half) {
    return geometry::Fills(patch, {at - half, at + Vector2(half.x(), -half.y()), at + half,
                                   at + Vector2(-half.x(), half.y())});
  });
}

TouchingCells CellsOfLine(const Interval& along) {
  const double half = (along.high - along.low) / 2 / kCellsPerSide;
  TouchingCells cells{.middles = {}, .half = {0, half}};
  for (int i = 0; i < kCellsPerSide; ++i) {
    cells.middles.emplace_back(0, along.low + (2 * i + 1) * half);
  }
  return cells;
}

}  // namespace

OffInHand OffInHandOf(const UncertainWorld& world, const HeldError& held) {
  const auto most = [&](const Expression& e) { return Magnitude(world.RangeOf(e)); };
  return {.shift = {most(held.x), most(held.y), most(held.z)},
          .turn = most(held.skew) + most(held.tip) + most(held.twist),
          .rolls = held.is_round,
          .rolled = held.is_round ? most(held.skew) : 0};
}

// A rolled part touches at a corner between two faces, or on one of them. Its line of contact is
// within half a face of its middle.
TouchingCells TouchingCellsOf(const domain::PartModel& model, const plan::Hold& hold, double side,
                              const Vector2& pad, const OffInHand& off) {
  const Vector2 may_shift =
      Vector2(off.shift.x(), off.shift.z()).array() + (off.turn - off.rolled) * pad.norm();
  if (!LieOnFaces(model, hold, pad)) {
    const geometry::Patches patch = OppositePatch(model, hold, pad - may_shift);
    if (patch.empty()) return {};
    const Eigen::AlignedBox2d bounds = BoundsOf(patch);
    if (off.rolls) return CellsOfLine({bounds.min().y(), bounds.max().y()});
    return CellsOfPatch(patch);
  }
  const domain::Face* face = FaceAt(model, hold, side);
  const auto covers = [&](const Vector2& middle, const Vector2& half) {
    return face->Covers(OnFaceOf(*face, hold, side, middle, half + may_shift));
  };
  const bool covers_all = covers(Vector2::Zero(), pad);
  return Divided(Vector2::Zero(), pad, [&](const Vector2& middle, const Vector2& half) {
    return covers_all || covers(middle, half);
  });
}

}  // namespace assay::uncertainty
