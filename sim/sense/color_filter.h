#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/render/picture_library.h"

namespace assay::sense {

// Red, green and blue, 0 to 1.
using Color = Eigen::Vector3d;

// Tells pixels of one colour by hue and saturation, whatever light falls on them: the colour
// filtering of Gaschler et al. 2013 (III-B). A pixel passes if its hue is within kHue degrees of
// the colour's, its saturation within kSaturation, and it is not too dark to tell.
class ColorFilter {
 public:
  static constexpr float kHue = 20;                // degrees
  static constexpr float kSaturation = 0.2f;       // 0: grey, 1: pure
  static constexpr float kLeastSaturation = 0.2f;  // of a colour that has a hue to tell it by
  static constexpr float kLeastValue = 0.1f;       // of a pixel: the greatest of its channels

  explicit ColorFilter(const Color& color);

  // Whether the colour is far enough from grey.
  bool HasHue() const { return saturation_ >= kLeastSaturation; }
  // Whether there are pixels that pass both.
  bool Overlaps(const ColorFilter& other) const;

  // For each pixel, rows from the top: 255 if it passes, else 0.
  std::vector<std::uint8_t> Pass(const render::Image& image) const;

 private:
  bool Passes(const render::HueSaturationValue& pixel) const;

  float hue_ = 0;  // degrees
  float saturation_ = 0;
};

}  // namespace assay::sense
