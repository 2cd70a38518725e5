#include "sim/opencv/lettering.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace assay::opencv {
namespace {

constexpr int kLetters = cv::FONT_HERSHEY_SIMPLEX;
const cv::Scalar kInk(40, 40, 40);

}  // namespace

Lettering::Lettering(int height) : scale_(height / 40.0), thickness_(std::max(1, height / 30)) {}

std::string Lettering::Fitted(const std::string& text, int width) const {
  if (Width(text) <= width) return text;
  std::string start = text;
  while (!start.empty() && Width(start + "...") > width) start.pop_back();
  return start + "...";
}

int Lettering::Width(const std::string& text) const {
  int baseline = 0;
  return cv::getTextSize(text, kLetters, scale_, thickness_, &baseline).width;
}

void Lettering::Write(const std::string& text, int x, int y, cv::Mat& picture) const {
  cv::putText(picture, text, {x, y}, kLetters, scale_, kInk, thickness_, cv::LINE_AA);
}

}  // namespace assay::opencv
