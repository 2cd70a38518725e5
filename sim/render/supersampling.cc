#include "sim/render/supersampling.h"

#include <opencv2/imgproc.hpp>

namespace assay::render {

Image FromSamples(const Image& drawing, int samples) {
  Image picture{drawing.width / samples, drawing.height / samples, {}};
  picture.rgb.resize(std::size_t{3} * picture.width * picture.height);
  // OpenCV has no type for memory that is only read.
  const cv::Mat from(drawing.height, drawing.width, CV_8UC3,
                     const_cast<std::uint8_t*>(drawing.rgb.data()));
  cv::Mat to(picture.height, picture.width, CV_8UC3, picture.rgb.data());
  cv::Mat small;
  cv::resize(from, small, to.size(), 0, 0, cv::INTER_AREA);
  cv::flip(small, to, 0);
  return picture;
}

}  // namespace assay::render
