#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

// A face of a Wavefront OBJ file. Its corners are ObjText::corners from `first` on.
struct ObjFace {
  std::size_t first = 0;
  std::size_t count = 0;  // at least 3
  int line = 0;
};

// An object or group of the file (a line "o NAME" or "g NAME"), which has at least one vertex. Its
// vertices are those from `first` on, up to the next object's.
struct ObjObject {
  std::size_t first = 0;
  int line = 1;
};

// The vertices, faces and objects of a Wavefront OBJ text, in the units of the file.
struct ObjText {
  std::vector<Vector3> vertices;
  std::vector<int> corners;  // of all faces: indices of vertices
  std::vector<ObjFace> faces;
  std::vector<ObjObject> objects;
};

// Reads a Wavefront OBJ text. Normals, textures and materials are skipped. `file` is its name for
// messages. Throws InputError with the line if a line cannot be read, if a face names no vertex, or
// if a face has fewer than 3 or more than 10,000 corners.
ObjText ReadObj(std::string_view text, const std::string& file);

}  // namespace assay::geometry
