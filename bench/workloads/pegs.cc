#include "bench/workloads/pegs.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace assay::workloads {

namespace {

constexpr double kBlock = 2.5;  // half width of the block around a hole, as a multiple of the peg's

// Returns the corner where sides k - 1 and k of a prism meet.
Vector3 Corner(const PrismModel& model, int k, double z) {
  const double half_turn = std::numbers::pi / model.sides;
  const double angle = (2 * k - 1) * half_turn;
  const double radius = model.half / std::cos(half_turn);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

Polyhedron FromOutlines(const std::vector<Vector3>& corners,
                        const std::vector<std::vector<int>>& outlines) {
  Polyhedron shape;
  std::map<std::pair<int, int>, int> face_left_of;
  for (const std::vector<int>& outline : outlines) {
    finemotion::OuterFace face;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      face.region.resize(1);
      face.region[0].push_back(corners[static_cast<std::size_t>(outline[i])]);
      face_left_of[{outline[i], outline[(i + 1) % outline.size()]}] =
          static_cast<int>(shape.faces.size());
    }
    const std::vector<Vector3>& polygon = face.region[0];
    face.normal = (polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]).normalized();
    face.height = face.normal.dot(polygon[0]);
    shape.faces.push_back(face);
  }
  for (const Vector3& corner : corners) shape.vertices.push_back({corner, {}});
  for (const auto& [ends, face] : face_left_of) {
    const auto start = static_cast<std::size_t>(ends.first);
    const auto end = static_cast<std::size_t>(ends.second);
    if (start > end) continue;
    const int index = static_cast<int>(shape.edges.size());
    shape.edges.push_back(
        {corners[start], corners[end], {face, face_left_of.at({ends.second, ends.first})}});
    shape.vertices[start].edges.push_back(index);
    shape.vertices[end].edges.push_back(index);
  }
  return shape;
}

Polyhedron BoxShape(const Vector3& low, const Vector3& high) {
  return FromOutlines(
      BoxPiece(low, high).corners,
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

Polyhedron CubeShape(double half) {
  return BoxShape(Vector3::Constant(-half), Vector3::Constant(half));
}

Polyhedron SquareHoleShape(double half, double outer, double depth) {
  Polyhedron shape;
  finemotion::OuterFace top{Vector3::UnitZ(), 0, {}};
  for (const double side : {1.0, -1.0}) {
    const double in = side * half;
    const double out = side * outer;
    top.region.push_back({{in, -side * outer, 0},
                          {out, -side * outer, 0},
                          {out, side * outer, 0},
                          {in, side * outer, 0}});
    top.region.push_back({{half, in, 0}, {half, out, 0}, {-half, out, 0}, {-half, in, 0}});
  }
  // Makes the outlines counter-clockwise from above.
  for (std::vector<Vector3>& outline : top.region) {
    if ((outline[1] - outline[0]).cross(outline[2] - outline[1]).z() < 0) {
      outline = {outline[3], outline[2], outline[1], outline[0]};
    }
  }
  shape.faces.push_back(top);
  Vector3 outward = Vector3::UnitX();
  Vector3 along = Vector3::UnitY();
  for (int wall = 1; wall <= 4; ++wall) {
    const Vector3 start = half * (outward - along);
    const Vector3 end = half * (outward + along);
    const Vector3 down(0, 0, -depth);
    shape.faces.push_back({-outward, -half, {{end, end + down, start + down, start}}});
    shape.edges.push_back({start, end, {0, wall}});
    outward = std::exchange(along, -outward);
  }
  return shape;
}

ConvexPiece BoxPiece(const Vector3& low, const Vector3& high) {
  ConvexPiece box;
  for (int i = 0; i < 8; ++i) {
    box.corners.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                             (i & 4) != 0 ? high.z() : low.z());
  }
  return box;
}

ConvexPiece PrismPiece(const PrismModel& model) {
  ConvexPiece prism;
  for (int k = 0; k < model.sides; ++k) {
    for (const double z : {0.0, model.length}) prism.corners.push_back(Corner(model, k, z));
  }
  return prism;
}

std::vector<ConvexPiece> AroundHole(const PrismModel& model, double outer) {
  const PrismModel outside = {.sides = model.sides, .half = outer, .length = model.length};
  std::vector<ConvexPiece> pieces;
  for (int side = 0; side < model.sides; ++side) {
    ConvexPiece& piece = pieces.emplace_back();
    for (const int k : {side, side + 1}) {
      for (const double z : {0.0, -model.length}) {
        piece.corners.push_back(Corner(model, k, z));
        piece.corners.push_back(Corner(outside, k, z));
      }
    }
  }
  return pieces;
}

finemotion::Passage PegInHole(const PrismModel& peg, double play) {
  PrismModel hole = peg;
  hole.half += play;
  finemotion::Passage passage;
  passage.moving = finemotion::OutsideOf({PrismPiece(peg)});
  passage.stationary = finemotion::OutsideOf(AroundHole(hole, kBlock * peg.half));
  passage.seat = 0.8 * peg.length;
  return passage;
}

}  // namespace assay::workloads
