#pragma once

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "planner/geometry/solids/triangulation.h"
#include "planner/mesh_import/meshes/triangle_mesh.h"
#include "tests/scratch_file.h"

// Meshes that tests make, in millimetres, and the files of them.
namespace assay::mesh_import {

using Curve = std::vector<Vector2>;  // counter-clockwise

inline Curve CircleOf(double radius, int sides, Vector2 center = {0, 0}) {
  Curve curve;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.25) / sides;
    curve.push_back(center + radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  return curve;
}

inline Curve RectangleOf(double x, double y, Vector2 center = {0, 0}) {
  return {center + Vector2(-x, -y) / 2, center + Vector2(x, -y) / 2, center + Vector2(x, y) / 2,
          center + Vector2(-x, y) / 2};
}

// A curve at a height.
struct MadeRing {
  double height = 0;
  Curve curve;
};
// A wall between rings of equally many corners, from low to high.
using MadeWall = std::vector<MadeRing>;

class MadeMesh {
 public:
  // Adds the walls of an outline, or of a hole in it.
  void AddWall(const MadeWall& wall, bool is_hole) {
    for (std::size_t r = 1; r < wall.size(); ++r) {
      const std::size_t count = wall[r].curve.size();
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const int a = Add(wall[r - 1].curve[i], wall[r - 1].height);
        const int b = Add(wall[r - 1].curve[next], wall[r - 1].height);
        const int c = Add(wall[r].curve[next], wall[r].height);
        const int d = Add(wall[r].curve[i], wall[r].height);
        AddTriangle(a, is_hole ? c : b, is_hole ? b : c);
        AddTriangle(a, is_hole ? d : c, is_hole ? c : d);
      }
    }
  }

  // Adds a flat end between an outline and holes in it, which looks up or down.
  void AddEnd(double height, const Curve& outline, const std::vector<Curve>& holes, bool looks_up) {
    std::vector<Vector2> points = outline;
    std::vector<geometry::Loop> loops(1);
    for (int i = 0; i < static_cast<int>(outline.size()); ++i) loops[0].push_back(i);
    for (const Curve& hole : holes) {
      geometry::Loop loop;
      for (auto corner = hole.rbegin(); corner != hole.rend(); ++corner) {
        loop.push_back(static_cast<int>(points.size()));
        points.push_back(*corner);
      }
      loops.push_back(loop);
    }
    for (const auto& [a, b, c] : geometry::Triangulated(points, loops)) {
      const auto at = [&](int i) { return Add(points[static_cast<std::size_t>(i)], height); };
      AddTriangle(at(a), at(looks_up ? b : c), at(looks_up ? c : b));
    }
  }

  TriangleMesh mesh;

 private:
  int Add(const Vector2& p, double height) {
    mesh.vertices.emplace_back(p.x(), p.y(), height);
    return static_cast<int>(mesh.vertices.size()) - 1;
  }
  void AddTriangle(int a, int b, int c) {
    const int number = static_cast<int>(mesh.triangles.size()) + 1;
    mesh.triangles.push_back({.corners = {a, b, c}, .number = number, .line = 0});
  }
};

// Returns a body with walls from end to end. Holes go through.
inline TriangleMesh Through(const MadeWall& outline, const std::vector<MadeWall>& holes) {
  MadeMesh made;
  made.AddWall(outline, false);
  std::vector<Curve> low;
  std::vector<Curve> high;
  for (const MadeWall& hole : holes) {
    made.AddWall(hole, true);
    low.push_back(hole.front().curve);
    high.push_back(hole.back().curve);
  }
  made.AddEnd(outline.front().height, outline.front().curve, low, false);
  made.AddEnd(outline.back().height, outline.back().curve, high, true);
  return made.mesh;
}

inline TriangleMesh Extruded(const Curve& outline, double height,
                             const std::vector<Curve>& holes = {}) {
  std::vector<MadeWall> walls;
  for (const Curve& hole : holes) walls.push_back({{0, hole}, {height, hole}});
  return Through({{0, outline}, {height, outline}}, walls);
}

// Returns a round peg with chamfers at both ends.
inline TriangleMesh ChamferedPeg(double radius, double length, double chamfer, int sides) {
  return Through({{0, CircleOf(radius - chamfer, sides)},
                  {chamfer, CircleOf(radius, sides)},
                  {length - chamfer, CircleOf(radius, sides)},
                  {length, CircleOf(radius - chamfer, sides)}},
                 {});
}

// Returns a foot from z = 0 to `foot` with a stem on it that ends at `tip`.
inline TriangleMesh FootWithStem(const Curve& foot, const Curve& stem, double shoulder,
                                 double tip) {
  MadeMesh made;
  made.AddWall({{0, foot}, {shoulder, foot}}, false);
  made.AddWall({{shoulder, stem}, {tip, stem}}, false);
  made.AddEnd(0, foot, {}, false);
  made.AddEnd(shoulder, foot, {stem}, true);
  made.AddEnd(tip, stem, {}, true);
  return made.mesh;
}

// Returns a block with a blind hole from above.
inline TriangleMesh BlockWithBlindHole(const Curve& block, const Curve& hole, double floor,
                                       double height) {
  MadeMesh made;
  made.AddWall({{0, block}, {height, block}}, false);
  made.AddWall({{floor, hole}, {height, hole}}, true);
  made.AddEnd(0, block, {}, false);
  made.AddEnd(floor, hole, {}, true);
  made.AddEnd(height, block, {hole}, true);
  return made.mesh;
}

inline void Append(TriangleMesh& mesh, const TriangleMesh& other, const Vector3& offset) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (const Vector3& vertex : other.vertices) mesh.vertices.push_back(vertex + offset);
  for (Triangle triangle : other.triangles) {
    for (int& corner : triangle.corners) corner += first;
    mesh.triangles.push_back(triangle);
  }
}

inline std::string StlText(const TriangleMesh& mesh) {
  std::string text = "solid made\n";
  for (const Triangle& triangle : mesh.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const Vector3& p = mesh.Corner(triangle, k);
      text += fmt::format("      vertex {:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid made\n";
}

inline std::string BinaryStl(const TriangleMesh& mesh) {
  std::string bytes(84 + 50 * mesh.triangles.size(), '\0');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + 80, &count, sizeof(count));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    char* at = bytes.data() + 84 + 50 * i + 12;
    for (int k = 0; k < 3; ++k) {
      const Vector3& p = mesh.Corner(mesh.triangles[i], k);
      for (int axis = 0; axis < 3; ++axis, at += sizeof(float)) {
        const auto coordinate = static_cast<float>(p[axis]);
        std::memcpy(at, &coordinate, sizeof(coordinate));
      }
    }
  }
  return bytes;
}

inline std::string ObjText(const TriangleMesh& mesh) {
  std::string text;
  for (const Vector3& p : mesh.vertices)
    text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
  for (const Triangle& triangle : mesh.triangles)
    text += fmt::format("f {} {} {}\n", triangle.corners[0] + 1, triangle.corners[1] + 1,
                        triangle.corners[2] + 1);
  return text;
}

inline std::filesystem::path Written(const std::string& name, const std::string& contents) {
  const std::filesystem::path file = ScratchFile(name);
  std::ofstream(file, std::ios::binary) << contents;
  return file;
}

}  // namespace assay::mesh_import
