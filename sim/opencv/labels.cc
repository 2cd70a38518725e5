#include "sim/opencv/labels.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sim/opencv/pixels.h"
#include "sim/render/picture.h"

namespace assay::opencv {
namespace {

using render::Label;

constexpr int kLabelFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kBeside = 14;  // pixels between a text and the point that it labels
constexpr int kPadding = 3;

double LabelScale(const cv::Mat& picture) { return std::max(0.35, picture.cols / 1300.0); }

cv::Size BoxSize(const std::string& text, double scale) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, kLabelFont, scale, 1, &baseline);
  return {size.width + 2 * kPadding, size.height + baseline + 2 * kPadding};
}

// Returns a place beside the point, on the side with more room, below the labels that are already
// there.
cv::Rect PlaceBeside(const cv::Point& at, const cv::Size& size, const cv::Size& picture,
                     const std::vector<cv::Rect>& taken) {
  const int x = at.x < picture.width / 2 ? at.x + kBeside : at.x - kBeside - size.width;
  cv::Rect place({std::clamp(x, 0, std::max(0, picture.width - size.width)),
                  std::clamp(at.y - size.height / 2, 0, std::max(0, picture.height - size.height))},
                 size);
  const auto overlaps = [&](const cv::Rect& other) { return (other & place).area() > 0; };
  for (std::size_t i = 0; i <= taken.size(); ++i) {
    const auto in_the_way = std::ranges::find_if(taken, overlaps);
    if (in_the_way == taken.end()) break;
    place.y = in_the_way->y + in_the_way->height;
  }
  return place;
}

void Draw(const Label& label, const cv::Rect& place, cv::Mat& picture) {
  const auto [red, green, blue] = label.colour.Rgb();
  const cv::Scalar colour(red, green, blue);
  const cv::Point at(static_cast<int>(label.x), static_cast<int>(label.y));
  const int end = at.x < place.x ? place.x : place.x + place.width;
  cv::line(picture, at, {end, place.y + place.height / 2}, colour, 1, cv::LINE_AA);
  cv::rectangle(picture, place, cv::Scalar::all(255), cv::FILLED);
  cv::rectangle(picture, place, colour, 1);
  const cv::Point baseline(place.x + kPadding, place.y + place.height * 7 / 10);
  cv::putText(picture, label.text, baseline, kLabelFont, LabelScale(picture),
              cv::Scalar(20, 32, 46), 1, cv::LINE_AA);
}

}  // namespace

render::Image WithLabels(const render::Image& image, std::span<const Label> labels) {
  cv::Mat picture = PixelsOf(image).clone();
  std::vector<cv::Rect> taken;
  for (const Label& label : labels) {
    const cv::Point at(static_cast<int>(label.x), static_cast<int>(label.y));
    taken.push_back(
        PlaceBeside(at, BoxSize(label.text, LabelScale(picture)), picture.size(), taken));
    Draw(label, taken.back(), picture);
  }
  return ImageOf(picture);
}

}  // namespace assay::opencv
