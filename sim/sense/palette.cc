#include "sim/sense/palette.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"

namespace assay::sense {
namespace {

constexpr float kSameColor = 0.004f;    // greatest difference of the chromaticities of one colour
constexpr float kFarthest = 0.12f;      // greatest chromaticity difference of pixel and surface
constexpr float kLeastBrightness = 30;  // the least sum of red, green and blue
constexpr int kFirstUndrawnGroup = 3;

// Returns a geom's own colour, or its material's colour if its own is the engine's default.
const float* ColorOf(const mjModel& model, int geom) {
  const float* own = model.geom_rgba + 4 * geom;
  const bool is_default = own[0] == 0.5f && own[1] == 0.5f && own[2] == 0.5f && own[3] == 1;
  const int material = model.geom_matid[geom];
  return is_default && material >= 0 ? model.mat_rgba + 4 * material : own;
}

PartId PartOf(const scene::Scene& scene, mujoco::BodyId body) {
  for (int part = 0; part < scene.part_count(); ++part) {
    if (scene.Body(PartId(part)) == body) return PartId(part);
  }
  return PartId::None();
}

// The chromaticity of a colour, which does not depend on the light: red and green as shares of the
// sum of red, green and blue.
struct Chromaticity {
  float red = 0;
  float green = 0;

  float SquaredDistance(float other_red, float other_green) const {
    const float red_off = red - other_red;
    const float green_off = green - other_green;
    return red_off * red_off + green_off * green_off;
  }
};

}  // namespace

Surface SurfaceMap::At(double x, double y) const {
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  if (std::min(column, row) < 0 || std::max(column, row) >= size) return Surface::kElse;
  return surfaces[static_cast<std::size_t>(row) * size + column];
}

Palette::Palette(const scene::Scene& scene) {
  const mjModel& model = *scene.model().get();
  const mujoco::GeomId table = scene.model().Geom("table");
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_group[geom] >= kFirstUndrawnGroup) continue;
    const mujoco::BodyId body(model.geom_bodyid[geom]);
    Add(ColorOf(model, geom), PartOf(scene, body), mujoco::GeomId(geom) == table);
  }
}

void Palette::Add(const float* rgba, PartId part, bool is_table) {
  const float sum = std::max(rgba[0] + rgba[1] + rgba[2], 1e-3f);
  const float red = rgba[0] / sum;
  const float green = rgba[1] / sum;
  auto entry = std::ranges::find_if(entries_, [&](const Entry& known) {
    return std::hypot(known.red - red, known.green - green) < kSameColor;
  });
  if (entry == entries_.end()) entry = entries_.insert(entry, Entry{red, green});
  if (!part.IsNone()) entry->parts.push_back(part);
  entry->is_table = entry->is_table || is_table;
}

Surface Palette::SurfaceOf(const Entry& entry, PartId part) {
  if (std::ranges::count(entry.parts, part) > 0) return Surface::kPart;
  if (!entry.parts.empty()) return Surface::kOtherPart;
  return entry.is_table ? Surface::kTable : Surface::kElse;
}

Surface Palette::SurfaceIn(const std::uint8_t* rgb, PartId part) const {
  const auto brightness = static_cast<float>(rgb[0] + rgb[1] + rgb[2]);
  if (brightness < kLeastBrightness) return Surface::kElse;
  const Chromaticity seen = {rgb[0] / brightness, rgb[1] / brightness};
  Surface surface = Surface::kElse;
  float nearest = kFarthest * kFarthest;
  for (const Entry& entry : entries_) {
    const float distance = seen.SquaredDistance(entry.red, entry.green);
    if (distance >= nearest) continue;
    nearest = distance;
    surface = SurfaceOf(entry, part);
  }
  return surface;
}

SurfaceMap Palette::Segment(const render::Image& image, PartId part) const {
  ASSAY_CHECK(image.width == image.height);
  SurfaceMap map{image.width, {}};
  map.surfaces.reserve(image.rgb.size() / 3);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    map.surfaces.push_back(SurfaceIn(&image.rgb[i], part));
  }
  return map;
}

}  // namespace assay::sense
