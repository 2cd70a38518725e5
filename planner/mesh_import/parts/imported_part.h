#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/mesh_import/files/mesh_file.h"
#include "planner/mesh_import/parts/part_sketch.h"
#include "planner/mesh_import/parts/part_text.h"

namespace assay::mesh_import {

struct ImportOptions {
  std::optional<MeshUnit> unit = {};  // none: found from the size
  PartMaterial material = {};
  int sides = 32;  // of round solids and pockets, a multiple of 4
};

// What was made of one closed body, or of a part of it.
struct BodyAccount {
  std::string file;
  BodyShape shape;
};

// A part that was made from meshes, with a report of how it was made.
struct ImportedPart {
  PartSketch sketch;
  ImportOptions options;
  std::optional<MeshUnit> unit = {};  // of the files that do not tell it; none if all tell it
  std::vector<std::string> files;     // names without folders
  std::vector<std::string> repairs;   // sentences
  std::vector<BodyAccount> bodies;    // the largest first
  int triangles = 0;                  // of all files

  int Pieces() const;            // solids, pockets and convex pieces
  double Distance() const;       // greatest distance between files and part, metres
  double Volume() const;         // of the files, cubic metres
  std::string PartFile() const;  // the text of part.yaml
  // Returns the files of convex pieces beside the part file, as names and texts.
  std::vector<std::pair<std::string, std::string>> PieceFiles() const;
};

}  // namespace assay::mesh_import
