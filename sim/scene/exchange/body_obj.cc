#include "sim/scene/exchange/body_obj.h"

#include <fmt/format.h>

#include "sim/scene/exchange/exported_body.h"

namespace assay::scene {

std::string PieceToObj(const std::string& name, const geometry::ConvexHull& piece, int first) {
  std::string text = fmt::format("o {}\n", name);
  for (const geometry::Vector3& p : piece.vertices) {
    text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  }
  for (const geometry::Facet& facet : piece.facets) {
    text += "f";
    for (const int vertex : facet.loop) text += fmt::format(" {}", first + vertex);
    text += "\n";
  }
  return text;
}

std::string BodiesToObj(const std::vector<ExportedBody>& bodies) {
  std::string text;
  int first = 1;
  for (const ExportedBody& body : bodies) {
    const auto pieces = geometry::Transformed(body.model->pieces(), body.X_WorldPart);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      text += PieceToObj(fmt::format("{}-{}", body.name, i + 1), pieces[i], first);
      first += static_cast<int>(pieces[i].vertices.size());
    }
  }
  return text;
}

}  // namespace assay::scene
