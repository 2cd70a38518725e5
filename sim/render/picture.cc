#include "sim/render/picture.h"

#include <algorithm>

#include "planner/base/check.h"
#include "sim/render/picture_library.h"

namespace assay::render {
namespace {

void RequireEveryPixel(const Image& image) {
  ASSAY_CHECK(image.rgb.size() == std::size_t{3} * image.width * image.height);
}

}  // namespace

std::string EncodedPng(const Image& image) {
  RequireEveryPixel(image);
  const std::vector<std::uint8_t> bytes = Pictures().EncodePng(image);
  return {bytes.begin(), bytes.end()};
}

Image ContactSheet(const std::vector<CaptionedImage>& images, int columns,
                   const std::vector<LegendEntry>& legend) {
  ASSAY_CHECK(!images.empty() && columns >= 1);
  for (const auto& [caption, image] : images) {
    RequireEveryPixel(image);
    ASSAY_CHECK(image.width == images.front().image.width &&
                image.height == images.front().image.height);
  }
  return Pictures().ContactSheet(images, columns, legend);
}

Image WithLabels(const Image& image, const std::vector<Label>& labels) {
  RequireEveryPixel(image);
  return Pictures().WithLabels(image, labels);
}

Image WithCaption(const Image& image, const Caption& caption) {
  RequireEveryPixel(image);
  return Pictures().WithCaption(image, caption);
}

Image FromSamples(const Image& drawing, int samples) {
  RequireEveryPixel(drawing);
  return Pictures().FromSamples(drawing, samples);
}

}  // namespace assay::render
