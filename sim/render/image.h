#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/render/palette.h"

namespace assay::render {

// An RGB picture with 8 bits per channel, in rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height bytes

  bool operator==(const Image&) const = default;
};

struct CaptionedImage {
  std::string caption;  // like "3 putdown(block, BP5)"; cut with an ellipsis if it is too long
  Image image;
};

// A strip below a picture.
struct Caption {
  std::string text;    // on the left; cut with an ellipsis if it is too long
  std::string number;  // on the right: "12.4 s"
  int height = 0;      // pixels
};

// A text beside a point of a picture.
struct Label {
  std::string text;
  double x = 0;  // pixels, from the left
  double y = 0;  // pixels, from the top
  Colour colour;
};

// The meaning of a colour of lines in the images.
struct LegendEntry {
  Colour colour;
  std::string meaning;
};

}  // namespace assay::render
