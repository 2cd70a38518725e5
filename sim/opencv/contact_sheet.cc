#include "sim/opencv/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "sim/opencv/lettering.h"
#include "sim/opencv/pixels.h"
#include "sim/render/picture.h"

namespace assay::opencv {
namespace {

using render::CaptionedImage;
using render::Image;
using render::LegendEntry;

// The layout of a contact sheet, in pixels, for images of one width.
struct SheetLayout {
  int margin = 0;
  int caption = 0;  // height
  Lettering lettering;

  explicit SheetLayout(int image_width)
      : margin(std::max(6, image_width / 40)),
        caption(std::max(18, image_width / 20)),
        lettering(caption) {}
};

constexpr int kWidest = 2400;  // pixels; the greatest width of a sheet

void DrawCell(const CaptionedImage& cell, const cv::Point& corner, const SheetLayout& layout,
              cv::Mat& sheet) {
  const Image& image = cell.image;
  PixelsOf(image).copyTo(sheet(cv::Rect(corner.x, corner.y, image.width, image.height)));
  layout.lettering.Write(layout.lettering.Fitted(cell.caption, image.width), corner.x,
                         corner.y + image.height + layout.caption * 3 / 4, sheet);
}

void DrawLegendEntry(const LegendEntry& entry, const cv::Point& corner, const SheetLayout& layout,
                     cv::Mat& sheet) {
  const auto [red, green, blue] = entry.colour.Rgb();
  const int middle = corner.y + layout.caption / 2;
  cv::line(sheet, {corner.x, middle}, {corner.x + layout.caption, middle},
           cv::Scalar(red, green, blue), 2 * layout.lettering.thickness(), cv::LINE_AA);
  const int text = corner.x + layout.caption + layout.margin;
  layout.lettering.Write(layout.lettering.Fitted(entry.meaning, sheet.cols - layout.margin - text),
                         text, corner.y + layout.caption * 3 / 4, sheet);
}

// Makes the images smaller if the sheet would be too wide.
std::vector<CaptionedImage> Fitting(std::vector<CaptionedImage> images, int columns) {
  const Image& first = images.front().image;
  const double scale = static_cast<double>(kWidest) / (columns * first.width);
  if (scale >= 1) return images;
  const cv::Size size(std::max(1, static_cast<int>(scale * first.width)),
                      std::max(1, static_cast<int>(scale * first.height)));
  for (CaptionedImage& cell : images) {
    cv::Mat small;
    cv::resize(PixelsOf(cell.image), small, size, 0, 0, cv::INTER_AREA);
    cell.image = ImageOf(small);
  }
  return images;
}

}  // namespace

Image ContactSheet(const std::vector<CaptionedImage>& originals, int columns,
                   const std::vector<LegendEntry>& legend) {
  const int count = static_cast<int>(originals.size());
  const int used_columns = std::min(columns, count);
  const std::vector<CaptionedImage> images = Fitting(originals, used_columns);
  const int width = images.front().image.width;
  const int height = images.front().image.height;
  const SheetLayout layout(width);
  const int rows = (count + used_columns - 1) / used_columns;
  const cv::Size step(width + layout.margin, height + layout.caption + layout.margin);
  const int legend_height = static_cast<int>(legend.size()) * layout.caption;
  cv::Mat sheet(rows * step.height + layout.margin + legend_height,
                used_columns * step.width + layout.margin, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < count; ++i) {
    const cv::Point corner(layout.margin + i % used_columns * step.width,
                           layout.margin + i / used_columns * step.height);
    DrawCell(images[i], corner, layout, sheet);
  }
  cv::Point corner(layout.margin, rows * step.height + layout.margin / 2);
  for (const LegendEntry& entry : legend) {
    DrawLegendEntry(entry, corner, layout, sheet);
    corner.y += layout.caption;
  }
  return ImageOf(sheet);
}

}  // namespace assay::opencv
