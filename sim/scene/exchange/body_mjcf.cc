#include <fmt/format.h>

#include <span>

#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/exchange/exported_body.h"
#include "sim/scene/piece_mjcf.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {
namespace {

constexpr char kPieceClass[] = "piece";

// Only piece_mjcf.h knows whether a piece becomes a mesh, so the class has the type box.
void AddPieceDefaults(XmlElement& mujoco) {
  mujoco.Add("option").Set("timestep", 0.0005).Set("cone", "elliptic").Set("impratio", 10);
  mujoco.Add("default")
      .Add("default")
      .Set("class", kPieceClass)
      .Add("geom")
      .Set("type", "box")
      .Set("solref", "0.001 1")
      .Set("solimp", "0.99 0.9999 0.00001");
}

void AddBody(const ExportedBody& exported, XmlElement& asset, XmlElement& worldbody) {
  const domain::PartModel& model = *exported.model;
  XmlElement& body = worldbody.Add("body").Set("name", exported.name).SetPose(exported.X_WorldPart);
  if (!exported.is_fixed) body.Add("freejoint").Set("name", exported.name);
  AddMass(model.mass(), body);
  for (std::size_t i = 0; i < model.pieces().size(); ++i) {
    const Eigen::Vector4d color = model.colors()[i].cast<double>();
    AddPiece(model.pieces()[i], kPieceClass, fmt::format("{}-{}", exported.name, i + 1), body,
             asset)
        .Set("friction", {model.friction(), 0.005, 0.0001})
        .Set("rgba", std::span(color.data(), 4));
  }
}

}  // namespace

std::string BodiesToMjcf(const std::string& name, const std::vector<ExportedBody>& bodies) {
  XmlElement mujoco("mujoco");
  mujoco.Set("model", name);
  mujoco.Add("compiler").Set("angle", "radian");
  AddPieceDefaults(mujoco);
  XmlElement& asset = mujoco.Add("asset");
  XmlElement& worldbody = mujoco.Add("worldbody");
  for (const ExportedBody& body : bodies) AddBody(body, asset, worldbody);
  return mujoco.Text();
}

}  // namespace assay::scene
