#include "sim/opencv/caption.h"

#include <opencv2/core.hpp>

#include "sim/opencv/lettering.h"
#include "sim/opencv/pixels.h"

namespace assay::opencv {

render::Image WithCaption(const render::Image& image, const render::Caption& caption) {
  cv::Mat picture(image.height + caption.height, image.width, CV_8UC3, cv::Scalar::all(255));
  PixelsOf(image).copyTo(picture(cv::Rect(0, 0, image.width, image.height)));
  const Lettering lettering(caption.height);
  const int margin = caption.height / 3;
  const int baseline = image.height + caption.height * 3 / 4;
  const int right = image.width - margin - lettering.Width(caption.number);
  lettering.Write(caption.number, right, baseline, picture);
  lettering.Write(lettering.Fitted(caption.text, right - 2 * margin), margin, baseline, picture);
  return ImageOf(picture);
}

}  // namespace assay::opencv
