#include "sim/render/image.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "planner/base/check.h"
#include "planner/base/input_error.h"

namespace assay::render {
namespace {

cv::Mat ToMat(const Image& image) {
  ASSAY_CHECK(image.rgb.size() == std::size_t{3} * image.width * image.height);
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<std::uint8_t*>(image.rgb.data()));
  return rgb.clone();
}

Image ToImage(const cv::Mat& rgb) {
  Image image{rgb.cols, rgb.rows, {}};
  for (int row = 0; row < rgb.rows; ++row) {
    const auto* bytes = rgb.ptr<std::uint8_t>(row);
    image.rgb.insert(image.rgb.end(), bytes, bytes + std::ptrdiff_t{3} * rgb.cols);
  }
  return image;
}

// Layout of a contact sheet, in pixels, for images of one width.
struct SheetLayout {
  int margin = 0;
  int caption = 0;  // height
  double font_scale = 0;
  int thickness = 1;

  explicit SheetLayout(int image_width)
      : margin(std::max(6, image_width / 40)),
        caption(std::max(18, image_width / 20)),
        font_scale(caption / 40.0),
        thickness(std::max(1, caption / 30)) {}
};

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
const cv::Scalar kInk(40, 40, 40);

int TextWidth(const std::string& text, const SheetLayout& layout) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, layout.font_scale, layout.thickness, &baseline).width;
}

std::string Fitted(const std::string& caption, int width, const SheetLayout& layout) {
  if (TextWidth(caption, layout) <= width) return caption;
  std::string start = caption;
  while (!start.empty() && TextWidth(start + "...", layout) > width) start.pop_back();
  return start + "...";
}

void DrawCell(const CaptionedImage& cell, const cv::Point& corner, const SheetLayout& layout,
              cv::Mat& sheet) {
  const Image& image = cell.image;
  ToMat(image).copyTo(sheet(cv::Rect(corner.x, corner.y, image.width, image.height)));
  const cv::Point baseline(corner.x, corner.y + image.height + layout.caption * 3 / 4);
  cv::putText(sheet, Fitted(cell.caption, image.width, layout), baseline, kFont, layout.font_scale,
              kInk, layout.thickness, cv::LINE_AA);
}

void DrawLegendEntry(const LegendEntry& entry, const cv::Point& corner, const SheetLayout& layout,
                     cv::Mat& sheet) {
  const auto [red, green, blue] = entry.colour.Rgb();
  const int middle = corner.y + layout.caption / 2;
  cv::line(sheet, {corner.x, middle}, {corner.x + layout.caption, middle},
           cv::Scalar(red, green, blue), 2 * layout.thickness, cv::LINE_AA);
  const int text = corner.x + layout.caption + layout.margin;
  cv::putText(sheet, Fitted(entry.meaning, sheet.cols - layout.margin - text, layout),
              {text, corner.y + layout.caption * 3 / 4}, kFont, layout.font_scale, kInk,
              layout.thickness, cv::LINE_AA);
}

}  // namespace

void WritePng(const Image& image, const std::filesystem::path& file) {
  cv::Mat bgr;
  cv::cvtColor(ToMat(image), bgr, cv::COLOR_RGB2BGR);
  std::vector<std::uint8_t> bytes;
  ASSAY_CHECK(cv::imencode(".png", bgr, bytes));
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw EnvironmentError(file.string() + ": cannot be written");
}

Image ReadImage(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  const cv::Mat bgr = bytes.empty() ? cv::Mat() : cv::imdecode(bytes, cv::IMREAD_COLOR);
  if (bgr.empty()) throw InputError({file.string()}, "cannot be read as a picture", "PNG, JPEG");
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return ToImage(rgb);
}

Image ContactSheet(const std::vector<CaptionedImage>& images, int columns,
                   const std::vector<LegendEntry>& legend) {
  ASSAY_CHECK(!images.empty() && columns >= 1);
  const int width = images.front().image.width;
  const int height = images.front().image.height;
  const SheetLayout layout(width);
  const int count = static_cast<int>(images.size());
  const int used_columns = std::min(columns, count);
  const int rows = (count + used_columns - 1) / used_columns;
  const cv::Size step(width + layout.margin, height + layout.caption + layout.margin);
  const int legend_height = static_cast<int>(legend.size()) * layout.caption;
  cv::Mat sheet(rows * step.height + layout.margin + legend_height,
                used_columns * step.width + layout.margin, CV_8UC3, cv::Scalar::all(255));
  for (int i = 0; i < count; ++i) {
    ASSAY_CHECK(images[i].image.width == width && images[i].image.height == height);
    const cv::Point corner(layout.margin + i % used_columns * step.width,
                           layout.margin + i / used_columns * step.height);
    DrawCell(images[i], corner, layout, sheet);
  }
  cv::Point corner(layout.margin, rows * step.height + layout.margin / 2);
  for (const LegendEntry& entry : legend) {
    DrawLegendEntry(entry, corner, layout, sheet);
    corner.y += layout.caption;
  }
  return ToImage(sheet);
}

}  // namespace assay::render
