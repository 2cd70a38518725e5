#pragma once

#include "sim/render/image.h"

namespace cv {
class Mat;
}

namespace assay::opencv {

// The image's own bytes, which must outlive what is returned and not be written to: OpenCV has no
// type for memory that is only read.
cv::Mat PixelsOf(const render::Image& image);

render::Image ImageOf(const cv::Mat& rgb);

}  // namespace assay::opencv
