#include "sim/sense/palette.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "planner/base/check.h"

namespace assay::sense {
namespace {

constexpr float kSameColor = 0.004f;    // of chromaticities
constexpr float kFarthest = 0.12f;      // of a pixel's chromaticity from its surface's
constexpr float kLeastBrightness = 30;  // sum of red, green and blue
constexpr int kFirstUndrawnGroup = 3;

// A geom's own colour, unless it was left at the engine's default, else its material's.
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

struct Chromaticities {
  cv::Mat brightness;  // sum of the three
  cv::Mat red;
  cv::Mat green;
};

Chromaticities ChromaticitiesOf(const render::Image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<std::uint8_t*>(image.rgb.data()));
  cv::Mat numbers;
  rgb.convertTo(numbers, CV_32FC3);
  std::vector<cv::Mat> channels;
  cv::split(numbers, channels);
  const cv::Mat brightness = channels[0] + channels[1] + channels[2];
  const cv::Mat divisor = cv::max(brightness, 1.0);
  return {brightness, cv::Mat(channels[0] / divisor), cv::Mat(channels[1] / divisor)};
}

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

SurfaceMap Palette::Segment(const render::Image& image, PartId part) const {
  ASSAY_CHECK(image.width == image.height);
  const Chromaticities seen = ChromaticitiesOf(image);
  SurfaceMap map{image.width, std::vector<Surface>(image.rgb.size() / 3, Surface::kElse)};
  cv::Mat1b surfaces(image.height, image.width,
                     reinterpret_cast<std::uint8_t*>(map.surfaces.data()));
  cv::Mat nearest(surfaces.size(), CV_32F, cv::Scalar(kFarthest * kFarthest));
  for (const Entry& entry : entries_) {
    const cv::Mat red = seen.red - entry.red;
    const cv::Mat green = seen.green - entry.green;
    const cv::Mat distance = red.mul(red) + green.mul(green);
    surfaces.setTo(static_cast<int>(SurfaceOf(entry, part)), distance < nearest);
    nearest = cv::min(nearest, distance);
  }
  surfaces.setTo(static_cast<int>(Surface::kElse), seen.brightness < kLeastBrightness);
  return map;
}

}  // namespace assay::sense
