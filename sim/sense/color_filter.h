#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/render/picture_library.h"

namespace assay::sense {

// Red, green and blue, 0 to 1.
using Color = Eigen::Vector3d;

// Recognizes pixels of one colour by hue and saturation, independent of the light. It is the colour
// filtering of Gaschler et al. 2013 (III-B). A pixel passes if its hue is within kHue of the
// colour's hue, its saturation within kSaturation of the colour's, and its value at least
// kLeastValue.
class ColorFilter {
 public:
  static constexpr float kHue = 20;                // degrees
  static constexpr float kSaturation = 0.2f;       // on a scale from 0 (grey) to 1 (pure)
  static constexpr float kLeastSaturation = 0.2f;  // the least of a colour with a clear hue
  static constexpr float kLeastValue = 0.1f;       // the least value of a pixel that passes

  explicit ColorFilter(const Color& color);

  // Returns whether the colour is far enough from grey to have a clear hue.
  bool HasHue() const { return saturation_ >= kLeastSaturation; }
  // Returns whether some pixel passes both filters.
  bool Overlaps(const ColorFilter& other) const;

  // Returns 255 for each pixel that passes and 0 for each other one, in rows from the top.
  std::vector<std::uint8_t> Pass(const render::Image& image) const;

 private:
  bool Passes(const render::HueSaturationValue& pixel) const;

  float hue_ = 0;  // degrees
  float saturation_ = 0;
};

}  // namespace assay::sense
