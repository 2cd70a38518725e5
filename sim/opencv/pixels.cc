#include "sim/opencv/pixels.h"

#include <opencv2/core.hpp>

namespace assay::opencv {

cv::Mat PixelsOf(const render::Image& image) {
  return {image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.rgb.data())};
}

render::Image ImageOf(const cv::Mat& rgb) {
  render::Image image{rgb.cols, rgb.rows, {}};
  for (int row = 0; row < rgb.rows; ++row) {
    const auto* bytes = rgb.ptr<std::uint8_t>(row);
    image.rgb.insert(image.rgb.end(), bytes, bytes + std::ptrdiff_t{3} * rgb.cols);
  }
  return image;
}

}  // namespace assay::opencv
