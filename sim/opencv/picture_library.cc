#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sim/opencv/caption.h"
#include "sim/opencv/contact_sheet.h"
#include "sim/opencv/labels.h"
#include "sim/opencv/pixels.h"
#include "sim/render/picture.h"
#include "sim/render/picture_library.h"

namespace assay::opencv {
namespace {

using render::HueSaturationValue;
using render::Image;

// Converts an image whose red, green and blue are between 0 and 1.
std::vector<HueSaturationValue> InHsv(const cv::Mat& rgb) {
  cv::Mat hsv;
  cv::cvtColor(rgb, hsv, cv::COLOR_RGB2HSV);
  std::vector<HueSaturationValue> pixels;
  pixels.reserve(hsv.total());
  for (const cv::Vec3f& pixel : cv::Mat_<cv::Vec3f>(hsv)) {
    pixels.push_back({pixel[0], pixel[1], pixel[2]});
  }
  return pixels;
}

class OpenCv : public render::PictureLibrary {
 public:
  std::vector<std::uint8_t> EncodePng(const Image& image) const override {
    cv::Mat bgr;
    cv::cvtColor(PixelsOf(image), bgr, cv::COLOR_RGB2BGR);
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", bgr, bytes);
    return bytes;
  }

  std::optional<Image> Decode(std::span<const std::uint8_t> bytes) const override {
    if (bytes.empty()) return std::nullopt;
    const std::vector<std::uint8_t> file(bytes.begin(), bytes.end());
    const cv::Mat bgr = cv::imdecode(file, cv::IMREAD_COLOR);
    if (bgr.empty()) return std::nullopt;
    cv::Mat rgb;
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    return ImageOf(rgb);
  }

  Image ContactSheet(const std::vector<render::CaptionedImage>& images, int columns,
                     const std::vector<render::LegendEntry>& legend) const override {
    return opencv::ContactSheet(images, columns, legend);
  }

  Image WithLabels(const Image& image, std::span<const render::Label> labels) const override {
    return opencv::WithLabels(image, labels);
  }

  Image WithCaption(const Image& image, const render::Caption& caption) const override {
    return opencv::WithCaption(image, caption);
  }

  Image FromSamples(const Image& drawing, int samples) const override {
    const cv::Size size(drawing.width / samples, drawing.height / samples);
    cv::Mat small;
    cv::resize(PixelsOf(drawing), small, size, 0, 0, cv::INTER_AREA);
    cv::Mat upright;
    cv::flip(small, upright, 0);
    return ImageOf(upright);
  }

  std::vector<HueSaturationValue> InHsv(const Image& image) const override {
    cv::Mat rgb;
    PixelsOf(image).convertTo(rgb, CV_32FC3, 1.0 / 255);
    return opencv::InHsv(rgb);
  }

  HueSaturationValue InHsv(const std::array<float, 3>& rgb) const override {
    return opencv::InHsv(cv::Mat(1, 1, CV_32FC3, cv::Scalar(rgb[0], rgb[1], rgb[2]))).front();
  }

  void FillConvexPolygon(std::span<const std::array<int, 2>> corners, int fraction_bits,
                         render::Mask& mask) const override {
    std::vector<cv::Point> points;
    for (const auto& [x, y] : corners) points.emplace_back(x, y);
    cv::Mat1b pixels(mask.height, mask.width, mask.pixels.data());
    cv::fillConvexPoly(pixels, points, cv::Scalar(255), cv::LINE_8, fraction_bits);
  }
};

}  // namespace
}  // namespace assay::opencv

// render::Pictures gets the library from the module by this function.
extern "C" const assay::render::PictureLibrary* AssayPictureLibrary() {
  static const assay::opencv::OpenCv library;
  return &library;
}
