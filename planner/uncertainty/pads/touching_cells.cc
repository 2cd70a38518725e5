#include "planner/uncertainty/pads/touching_cells.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/polygon.h"

namespace assay::uncertainty {
namespace {

using geometry::Polygon;

constexpr double kOnFace = 1e-5;    // metres
constexpr double kSameFace = 1e-6;  // 1 - cosine

// Returns the face that a pad lies on. `side` is the pad's side along the tool's y.
const domain::Face* FaceAt(const domain::PartModel& model, const plan::Hold& hold, double side) {
  const Vector3 normal = side * hold.X_PartTool.linear().col(1);
  const double offset = normal.dot(hold.X_PartTool.translation()) + hold.width / 2;
  const auto is_it = [&](const domain::Face& face) {
    return face.normal.dot(normal) > 1 - kSameFace && std::abs(face.offset - offset) < kOnFace;
  };
  const auto found = std::ranges::find_if(model.faces(), is_it);
  return found == model.faces().end() ? nullptr : &*found;
}

// Returns the corners of a rectangle about `middle` (x and z of the tool), in the face's
// coordinates.
Polygon OnFaceOf(const domain::Face& face, const plan::Hold& hold, double side,
                 const Vector2& middle, const Vector2& half) {
  const Pose X_FaceTool = face.X_PartFace.inverse() * hold.X_PartTool;
  std::vector<Vector2> corners;
  for (const double x : {-half.x(), half.x()}) {
    for (const double z : {-half.y(), half.y()}) {
      const Vector3 corner(middle.x() + x, side * hold.width / 2, middle.y() + z);
      corners.push_back((X_FaceTool * corner).head<2>());
    }
  }
  return geometry::Hull2(corners);
}

}  // namespace

OffInHand OffInHandOf(const UncertainWorld& world, const HeldError& held) {
  const auto most = [&](const Expression& e) { return Magnitude(world.RangeOf(e)); };
  return {.shift = {most(held.x), most(held.y), most(held.z)},
          .turn = most(held.skew) + most(held.tip) + most(held.twist)};
}

std::vector<Vector2> TouchingCells(const domain::PartModel& model, const plan::Hold& hold,
                                   double side, const Vector2& pad, const OffInHand& off) {
  const domain::Face* face = FaceAt(model, hold, side);
  if (face == nullptr) return {};
  const Vector2 cell = pad / kCellsPerSide;
  const Vector2 may_shift = Vector2(off.shift.x(), off.shift.z()).array() + off.turn * pad.norm();
  const auto covers = [&](const Vector2& middle, const Vector2& half) {
    return face->Covers(OnFaceOf(*face, hold, side, middle, half + may_shift));
  };
  const bool covers_all = covers(Vector2::Zero(), pad);
  std::vector<Vector2> cells;
  for (int i = 0; i < kCellsPerSide; ++i) {
    for (int j = 0; j < kCellsPerSide; ++j) {
      const Vector2 middle = cell.cwiseProduct(2 * Vector2(i, j) + Vector2::Ones()) - pad;
      if (covers_all || covers(middle, cell)) cells.push_back(middle);
    }
  }
  return cells;
}

}  // namespace assay::uncertainty
