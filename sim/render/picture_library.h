#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/render/image.h"

namespace assay::render {

// A picture whose pixels are 0 or 255, in rows from the top.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // width * height elements

  Mask(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, 0) {}
};

struct HueSaturationValue {
  float hue = 0;         // degrees, 0 to 360
  float saturation = 0;  // from 0 (grey) to 1 (pure)
  float value = 0;       // the greatest of red, green and blue, from 0 to 1
};

// The operations on pictures that OpenCV implements. OpenCV needs more than a hundred shared
// libraries, most of them codecs, and opening them takes longer than most verbs. They are therefore
// in a module (sim/opencv) that is opened when the first picture is drawn, read or written.
class PictureLibrary {
 public:
  virtual ~PictureLibrary() = default;

  virtual std::vector<std::uint8_t> EncodePng(const Image& image) const = 0;
  // Returns the picture in the bytes of a PNG or JPEG file; none if they are neither.
  virtual std::optional<Image> Decode(std::span<const std::uint8_t> bytes) const = 0;
  // These implement the functions of the same names in picture.h.
  virtual Image ContactSheet(const std::vector<CaptionedImage>& images, int columns,
                             const std::vector<LegendEntry>& legend) const = 0;
  virtual Image WithLabels(const Image& image, std::span<const Label> labels) const = 0;
  virtual Image WithCaption(const Image& image, const Caption& caption) const = 0;
  virtual Image FromSamples(const Image& drawing, int samples) const = 0;

  // Returns hue, saturation and value of each pixel, in rows from the top.
  virtual std::vector<HueSaturationValue> InHsv(const Image& image) const = 0;
  // Returns hue, saturation and value of one colour. Its red, green and blue are from 0 to 1.
  virtual HueSaturationValue InHsv(const std::array<float, 3>& rgb) const = 0;

  // Sets the pixels of a convex polygon to 255. The corners are x and y in fractions of a pixel;
  // one pixel has two to the power of `fraction_bits` of them.
  virtual void FillConvexPolygon(std::span<const std::array<int, 2>> corners, int fraction_bits,
                                 Mask& mask) const = 0;
};

// Returns the only instance. The first call opens the module. Throws EnvironmentError if there is
// no module, or if a library that it needs is missing.
const PictureLibrary& Pictures();

}  // namespace assay::render
