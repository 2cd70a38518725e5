#include "planner/mesh_import/parts/imported_part.h"

#include <algorithm>

namespace assay::mesh_import {

int ImportedPart::Pieces() const {
  int count = static_cast<int>(sketch.pockets.size());
  for (const SketchSolid& solid : sketch.solids)
    count += solid.post ? 1 : static_cast<int>(solid.pieces.size());
  return count;
}

double ImportedPart::Distance() const {
  double distance = 0;
  for (const BodyAccount& body : bodies) distance = std::max(distance, body.shape.distance);
  return distance;
}

double ImportedPart::Volume() const {
  double volume = 0;
  for (const BodyAccount& body : bodies) volume += body.shape.volume;
  return volume;
}

std::string ImportedPart::PartFile() const {
  return PartText(sketch, options.material, options.sides);
}

std::vector<std::pair<std::string, std::string>> ImportedPart::PieceFiles() const {
  std::vector<std::pair<std::string, std::string>> files_of_pieces;
  for (const SketchSolid& solid : sketch.solids) {
    if (!solid.post) files_of_pieces.emplace_back(PieceFileName(solid), PieceText(solid));
  }
  return files_of_pieces;
}

}  // namespace assay::mesh_import
