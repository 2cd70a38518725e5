#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/render/palette.h"

namespace assay::render {

// An RGB picture, 8 bits a channel, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height bytes

  bool operator==(const Image&) const = default;
};

struct CaptionedImage {
  std::string caption;  // "3 putdown(block, BP5)"; cut with an ellipsis where it is too long
  Image image;
};

// A text beside a point of a picture.
struct Label {
  std::string text;
  double x = 0;  // pixels, from the left
  double y = 0;  // from the top
  Colour colour;
};

// What a colour of lines in the images means.
struct LegendEntry {
  Colour colour;
  std::string meaning;
};

}  // namespace assay::render
