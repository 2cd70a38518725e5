#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/render/image.h"

namespace assay::sense {

// Red, green and blue, 0 to 1.
using Color = Eigen::Vector3d;

// Tells pixels of one colour by hue and saturation, whatever light falls on them: the colour
// filtering of Gaschler et al. 2013 (III-B). A pixel passes if its hue is within kHue degrees of
// the colour's, its saturation within kSaturation, and it is not too dark to tell.
class ColorFilter {
 public:
  static constexpr double kHue = 20;               // degrees
  static constexpr double kSaturation = 0.2;       // 0: grey, 1: pure
  static constexpr double kLeastSaturation = 0.2;  // of a colour that has a hue to tell it by
  static constexpr double kLeastValue = 0.1;       // of a pixel: the greatest of its channels

  explicit ColorFilter(const Color& color);

  // Whether the colour is far enough from grey.
  bool HasHue() const { return saturation_ >= kLeastSaturation; }
  // Whether there are pixels that pass both.
  bool Overlaps(const ColorFilter& other) const;

  // For each pixel, rows from the top: 255 if it passes, else 0.
  std::vector<std::uint8_t> Pass(const render::Image& image) const;

 private:
  double hue_ = 0;  // degrees
  double saturation_ = 0;
};

}  // namespace assay::sense
