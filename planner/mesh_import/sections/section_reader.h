#pragma once

#include <optional>
#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"
#include "planner/mesh_import/sections/column.h"

namespace assay::mesh_import {

// A range of heights that count as one level.
struct Level {
  double low = 0;
  double high = 0;
  double Middle() const { return (low + high) / 2; }
};

enum class Slant { kAlong, kAcross, kSlanting, kNone };

// Returns how a triangle lies to the axis, which is z. A triangle without width counts as none.
Slant SlantOf(const TriangleMesh& mesh, const Triangle& triangle, double tolerance);

// Returns the heights at which facets lie across the axis, or at which slanting facets have
// corners.
std::vector<Level> LevelsOf(const TriangleMesh& mesh, double tolerance);

// Reads the section of a mesh at one height.
class SectionReader {
 public:
  SectionReader(const TriangleMesh& mesh, const ColumnRules& rules) : mesh_(mesh), rules_(rules) {}

  // Returns the curves of a section as columns that have only a lower contour. Of a section with
  // very many curves it returns the first ones, more than kMostLoops.
  std::vector<Column> At(double height) const;

  // The sections just inside the two ends of a layer.
  struct Ends {
    std::vector<Column> bottom;
    std::vector<Column> top;
  };
  Ends EndsBetween(const Level& below, const Level& above) const;

  static constexpr std::size_t kMostLoops = 200;

 private:
  void Read(const std::vector<Vector2>& curve, std::vector<Column>& read) const;
  Column Hole(const std::vector<Vector2>& corners, std::optional<Vector2> mouth) const;

  const TriangleMesh& mesh_;
  const ColumnRules& rules_;
};

// Returns the column of `section` that is most like a column, or none if no column is of its kind.
// Kinds are outlines, holes, and slots in a side.
std::vector<Column>::iterator MostAlike(const Column& column, std::vector<Column>& section);

}  // namespace assay::mesh_import
