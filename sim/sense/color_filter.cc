#include "sim/sense/color_filter.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace assay::sense {
namespace {

// Hue in degrees, saturation and value from 0 to 1.
std::vector<cv::Mat> HsvOf(const cv::Mat& rgb) {
  cv::Mat hsv;
  cv::cvtColor(rgb, hsv, cv::COLOR_RGB2HSV);
  std::vector<cv::Mat> channels;
  cv::split(hsv, channels);
  return channels;
}

double HueDistance(double a, double b) { return std::abs(std::remainder(a - b, 360)); }

}  // namespace

ColorFilter::ColorFilter(const Color& color) {
  const cv::Vec3f rgb(static_cast<float>(color[0]), static_cast<float>(color[1]),
                      static_cast<float>(color[2]));
  const std::vector<cv::Mat> hsv =
      HsvOf(cv::Mat(1, 1, CV_32FC3, cv::Scalar(rgb[0], rgb[1], rgb[2])));
  hue_ = hsv[0].at<float>(0);
  saturation_ = hsv[1].at<float>(0);
}

bool ColorFilter::Overlaps(const ColorFilter& other) const {
  return HueDistance(hue_, other.hue_) <= 2 * kHue &&
         std::abs(saturation_ - other.saturation_) <= 2 * kSaturation;
}

std::vector<std::uint8_t> ColorFilter::Pass(const render::Image& image) const {
  const cv::Mat bytes(image.height, image.width, CV_8UC3,
                      const_cast<std::uint8_t*>(image.rgb.data()));
  cv::Mat rgb;
  bytes.convertTo(rgb, CV_32FC3, 1.0 / 255);
  const std::vector<cv::Mat> hsv = HsvOf(rgb);
  const cv::Mat off = cv::abs(hsv[0] - hue_);
  const cv::Mat hue_off = cv::min(off, 360 - off);
  const cv::Mat saturation_off = cv::abs(hsv[1] - saturation_);
  const cv::Mat passes =
      (hue_off <= kHue) & (saturation_off <= kSaturation) & (hsv[2] >= kLeastValue);
  return {passes.begin<std::uint8_t>(), passes.end<std::uint8_t>()};
}

}  // namespace assay::sense
