#include "planner/mesh_import/parts/part_sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/geometry/hull.h"

namespace assay::mesh_import {
namespace {

constexpr double kSameFrame = 1e-9;

const char* KindName(const SketchSolid& solid) {
  if (!solid.post) return "body";
  if (!solid.post->is_straight) return solid.post->at_low.IsCircle() ? "cone" : "taper";
  switch (solid.post->at_low.kind) {
    case Contour::Kind::kCircle:
      return "cylinder";
    case Contour::Kind::kRectangle:
      return "block";
    case Contour::Kind::kPolygon:
      return "prism";
  }
  return "";
}

double VolumeOfSolid(const SketchSolid& solid) {
  if (solid.post) return solid.post->Volume(false);
  Eigen::AlignedBox3d bounds;
  for (const geometry::ConvexHull& piece : solid.pieces) {
    for (const Vector3& vertex : piece.vertices) bounds.extend(vertex);
  }
  return bounds.volume();
}

void NameSolids(std::vector<SketchSolid>& solids) {
  const auto largest = std::ranges::max_element(solids, {}, VolumeOfSolid);
  int number = 1;
  for (SketchSolid& solid : solids) {
    solid.name = &solid == &*largest ? "body" : fmt::format("{}-{}", KindName(solid), ++number);
  }
}

void NamePockets(std::vector<SketchPocket>& pockets) {
  int number = 0;
  for (SketchPocket& pocket : pockets) {
    pocket.name = fmt::format("{}-{}", pocket.pocket.post.mouth ? "slot" : "hole", ++number);
  }
}

// Rounds the lengths of a post as the part file gives them. Normals of its sides then fit the file.
Post Rounded(Post post) {
  const auto round = [](double& metres) {
    constexpr double kDigit = 1e-7;  // metres
    metres = std::round(metres / kDigit) * kDigit;
  };
  for (Contour* contour : {&post.at_low, &post.at_high}) {
    for (Vector2& corner : contour->corners) std::ranges::for_each(corner, round);
    std::ranges::for_each(contour->center, round);
    round(contour->radius);
  }
  round(post.low);
  round(post.high);
  return post;
}

void AddBody(const BodyShape& body, PartSketch& sketch) {
  const Matrix3 R_PartFile = sketch.R_FilePart.transpose();
  if (!body.is_stack) {
    SketchSolid solid;
    solid.pieces = body.pieces;
    for (geometry::ConvexHull& piece : solid.pieces) {
      for (Vector3& vertex : piece.vertices) vertex = R_PartFile * vertex;
      for (geometry::Facet& facet : piece.facets) facet.normal = R_PartFile * facet.normal;
    }
    sketch.solids.push_back(std::move(solid));
    return;
  }
  const int first = static_cast<int>(sketch.solids.size());
  for (const Post& post : body.stack.solids) {
    sketch.solids.push_back({.name = {},
                             .R_PartLocal = R_PartFile * body.R_FileLocal,
                             .post = Rounded(post),
                             .pieces = {}});
  }
  for (const StackPocket& pocket : body.stack.pockets) {
    sketch.pockets.push_back({.name = {}, .solid = first + pocket.solid, .pocket = pocket});
    sketch.pockets.back().pocket.post = Rounded(pocket.post);
  }
}

Eigen::AlignedBox3d BoundsOf(const PartSketch& sketch) {
  Eigen::AlignedBox3d bounds;
  for (const SketchSolid& solid : sketch.solids) {
    for (const Vector3& corner : solid.Corners(32)) bounds.extend(corner);
  }
  return bounds;
}

}  // namespace

std::vector<Vector3> SketchSolid::Corners(int sides) const {
  std::vector<Vector3> corners;
  for (const geometry::ConvexHull& piece : pieces)
    corners.insert(corners.end(), piece.vertices.begin(), piece.vertices.end());
  if (!post) return corners;
  for (const bool top : {false, true}) {
    for (const Vector2& corner : (top ? post->at_high : post->at_low).Outline(sides)) {
      corners.emplace_back(R_PartLocal *
                           Vector3(corner.x(), corner.y(), top ? post->high : post->low));
    }
  }
  return corners;
}

bool PartSketch::CanBeMated() const {
  return std::ranges::any_of(features, [](const SketchFeature& feature) {
    return feature.kind != SketchFeature::Kind::kFace;
  });
}

bool PartSketch::Contains(const Vector3& p) const {
  const auto is_in_pocket = [&](int solid, const Vector3& local) {
    return std::ranges::any_of(pockets, [&](const SketchPocket& pocket) {
      return pocket.solid == solid && pocket.pocket.post.Contains(local);
    });
  };
  for (int i = 0; i < static_cast<int>(solids.size()); ++i) {
    const SketchSolid& solid = solids[static_cast<std::size_t>(i)];
    if (solid.post) {
      const Vector3 local = solid.R_PartLocal.transpose() * p;
      if (solid.post->Contains(local) && !is_in_pocket(i, local)) return true;
      continue;
    }
    for (const geometry::ConvexHull& piece : solid.pieces) {
      const bool inside = std::ranges::all_of(piece.facets, [&](const geometry::Facet& facet) {
        return facet.normal.dot(p) <= facet.offset;
      });
      if (inside) return true;
    }
  }
  return false;
}

PartSketch SketchOf(const std::string& name, const std::vector<BodyShape>& bodies) {
  PartSketch sketch;
  sketch.name = name;
  if (bodies.front().is_stack && !AxisOf(bodies.front().R_FileLocal))
    sketch.R_FilePart = bodies.front().R_FileLocal;
  for (const BodyShape& body : bodies) AddBody(body, sketch);
  NameSolids(sketch.solids);
  NamePockets(sketch.pockets);
  sketch.size = BoundsOf(sketch).diagonal().norm();
  return sketch;
}

std::optional<char> AxisOf(const Matrix3& R_PartLocal) {
  for (int axis = 0; axis < 3; ++axis) {
    Matrix3 renamed;
    for (int i = 0; i < 3; ++i) renamed.col(i) = Vector3::Unit((axis + 1 + i) % 3);
    if ((R_PartLocal - renamed).norm() < kSameFrame) return "xyz"[axis];
  }
  return std::nullopt;
}

}  // namespace assay::mesh_import
