#include "sim/scene/piece_mjcf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/coordinates.h"
#include "planner/geometry/hull.h"

namespace assay::scene {
namespace {

using geometry::Vector3;

void Append(const Vector3& vector, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), vector.begin(), vector.end());
}

// Each facet has vertices of its own, so that pictures show its edges sharp.
void AddMesh(const geometry::ConvexHull& piece, const Vector3& middle, const std::string& name,
             XmlElement& asset) {
  std::vector<double> vertices;
  std::vector<double> normals;
  std::vector<std::size_t> triangles;
  for (const geometry::Facet& facet : piece.facets) {
    const std::size_t first = vertices.size() / 3;
    for (const int vertex : facet.loop) {
      Append(piece.vertices[vertex] - middle, vertices);
      Append(facet.normal, normals);
    }
    for (std::size_t i = 2; i < facet.loop.size(); ++i) {
      triangles.insert(triangles.end(), {first, first + i - 1, first + i});
    }
  }
  asset.Add("mesh")
      .Set("name", name)
      .Set("vertex", vertices)
      .Set("normal", normals)
      .Set("face", fmt::format("{}", fmt::join(triangles, " ")));
}

Vector3 MiddleOf(const geometry::ConvexHull& piece) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3& vertex : piece.vertices) bounds.extend(vertex);
  return bounds.center();
}

}  // namespace

XmlElement& AddPiece(const geometry::ConvexHull& piece, const std::string& geom_class,
                     const std::string& name, XmlElement& body, XmlElement& asset) {
  XmlElement& geom = body.Add("geom").Set("class", geom_class);
  if (const std::optional<geometry::Box> box = geometry::AsBox(piece)) {
    return geom.Set("type", "box").SetPose(box->X_FrameBox).Set("size", box->half_extents);
  }
  const Vector3 middle = MiddleOf(piece);
  AddMesh(piece, middle, name, asset);
  return geom.Set("type", "mesh").Set("mesh", name).Set("pos", middle);
}

void AddMass(const geometry::MassProperties& mass, XmlElement& body) {
  const geometry::Matrix3& I = mass.inertia;
  body.Add("inertial")
      .Set("pos", mass.center)
      .Set("mass", mass.mass)
      .Set("fullinertia", {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)});
}

}  // namespace assay::scene
