#include "sim/sense/color_filter.h"

#include <algorithm>
#include <cmath>

#include "sim/render/picture_library.h"

namespace assay::sense {
namespace {

double HueDistance(double a, double b) { return std::abs(std::remainder(a - b, 360)); }

}  // namespace

ColorFilter::ColorFilter(const Color& color) {
  const Eigen::Vector3f rgb = color.cast<float>();
  const auto hsv = render::Pictures().InHsv({rgb[0], rgb[1], rgb[2]});
  hue_ = hsv.hue;
  saturation_ = hsv.saturation;
}

bool ColorFilter::Overlaps(const ColorFilter& other) const {
  return HueDistance(hue_, other.hue_) <= 2 * kHue &&
         std::abs(saturation_ - other.saturation_) <= 2 * kSaturation;
}

bool ColorFilter::Passes(const render::HueSaturationValue& pixel) const {
  const float off = std::abs(pixel.hue - hue_);
  return std::min(off, 360 - off) <= kHue &&
         std::abs(pixel.saturation - saturation_) <= kSaturation && pixel.value >= kLeastValue;
}

std::vector<std::uint8_t> ColorFilter::Pass(const render::Image& image) const {
  std::vector<std::uint8_t> passes;
  passes.reserve(image.rgb.size() / 3);
  for (const render::HueSaturationValue& pixel : render::Pictures().InHsv(image)) {
    passes.push_back(Passes(pixel) ? 255 : 0);
  }
  return passes;
}

}  // namespace assay::sense
