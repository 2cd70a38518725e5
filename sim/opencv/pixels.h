#pragma once

#include "sim/render/image.h"

namespace cv {
class Mat;
}

namespace assay::opencv {

// Returns a matrix over the image's own bytes. They must outlive the matrix, and must not be
// written through it: OpenCV has no type for read-only memory.
cv::Mat PixelsOf(const render::Image& image);

// Returns an image with a copy of the matrix's bytes.
render::Image ImageOf(const cv::Mat& rgb);

}  // namespace assay::opencv
