#pragma once

#include <cstdint>
#include <filesystem>
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

std::string EncodedPng(const Image& image);  // the contents of a PNG file
// Throws EnvironmentError if the file cannot be written completely.
void WritePng(const Image& image, const std::filesystem::path& file);
// Throws InputError if the file is not a readable picture.
Image ReadImage(const std::filesystem::path& file);

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

// The image with the labels, each joined to its point, no two of them on each other.
Image WithLabels(const Image& image, const std::vector<Label>& labels);

// What a colour of lines in the images means.
struct LegendEntry {
  Colour colour;
  std::string meaning;
};

// The images, all of one size, in rows of `columns`, each with its caption below, on white; the
// legend's entries below all, a row for each. Images are made smaller where a row of them would be
// wider than 2400 pixels.
Image ContactSheet(const std::vector<CaptionedImage>& images, int columns,
                   const std::vector<LegendEntry>& legend = {});

// The picture of a drawing that is `samples` times too wide and too high, and whose rows, as
// OpenGL's, begin at the bottom. OSMesa has no other antialiasing that is the same on every
// machine.
Image FromSamples(const Image& drawing, int samples);

}  // namespace assay::render
