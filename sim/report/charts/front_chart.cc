#include "sim/report/charts/front_chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/report/charts/drawing.h"
#include "sim/report/charts/palette.h"
#include "sim/report/numbers/figures.h"

namespace assay::report {
namespace {

using Point = std::array<double, 2>;

// The drawing, and the room of its curves inside of it, in pixels.
struct Frame {
  static constexpr double width = 560, height = 460;
  static constexpr double left = 70, right = width - 30;
  static constexpr double top = 24, bottom = height - 56;
};

// Returns the greatest number on an axis. Points without an unproved one beyond them have no end.
double Greatest(const FrontPicture& picture, std::size_t axis) {
  double greatest = 1.5 * picture.declared[axis];
  for (const FrontCurve& curve : picture.curves) {
    for (const Point& point : curve.unproved) greatest = std::max(greatest, 1.1 * point[axis]);
  }
  return greatest;
}

class Chart {
 public:
  explicit Chart(const FrontPicture& picture)
      : picture_(picture),
        across_{0, Greatest(picture, 0), Frame::left, Frame::right},
        up_{0, Greatest(picture, 1), Frame::bottom, Frame::top},
        svg_(Drawing(Frame::width, Frame::height,
                     fmt::format("Pareto front of {} and {}", picture.axes[0], picture.axes[1]))) {}

  Element Drawn() {
    AddStyle();
    if (picture_.curves.size() == 1) AddUnproved(picture_.curves.front());
    for (const FrontCurve& curve : picture_.curves) AddProved(curve);
    AddLabels();
    AddAxes();
    AddDeclared();
    return std::move(svg_);
  }

 private:
  void AddStyle() {
    svg_.Set("xmlns", "http://www.w3.org/2000/svg");
    svg_.Add(
        "style",
        fmt::format(
            "text{{font:13px sans-serif;fill:#333}}.axis{{stroke:#333}}"
            ".ground{{fill:#fff}}.grid{{stroke:#ddd}}.proved{{fill:{0};fill-opacity:.18;stroke:{0};"
            "stroke-width:2}}.unproved{{fill:{1};fill-opacity:.12;stroke:{1}}}"
            ".declared{{fill:#333}}",
            kPredicted.light, kViolated.light));
    AddBox(svg_, "ground", 0, 0, Frame::width, Frame::height);
    AddGrid();
  }

  void AddGrid() {
    for (const double tick : Ticks(across_, 6))
      AddLine(svg_, "grid", across_.At(tick), Frame::top, across_.At(tick), Frame::bottom);
    for (const double tick : Ticks(up_, 6))
      AddLine(svg_, "grid", Frame::left, up_.At(tick), Frame::right, up_.At(tick));
  }

  void AddAxes() {
    AddLine(svg_, "axis", Frame::left, Frame::bottom, Frame::right, Frame::bottom);
    AddLine(svg_, "axis", Frame::left, Frame::top, Frame::left, Frame::bottom);
    for (const double tick : Ticks(across_, 6))
      AddWords(svg_, "middle", across_.At(tick), Frame::bottom + 18, NumberText(tick));
    for (const double tick : Ticks(up_, 6))
      AddWords(svg_, "end", Frame::left - 6, up_.At(tick) + 4, NumberText(tick));
    AddWords(svg_, "middle", (Frame::left + Frame::right) / 2, Frame::height - 14,
             picture_.axes[0]);
    AddWords(svg_, "start", 8, Frame::top - 8, picture_.axes[1]);
  }

  void AddDeclared() {
    const double x = across_.At(picture_.declared[0]);
    const double y = up_.At(picture_.declared[1]);
    svg_.Add("circle").Set("class", "declared").Set("cx", x).Set("cy", y).Set("r", 4);
    AddWords(svg_, "start", x + 7, y - 6, "declared");
  }

  // Everything is proved for the union of the boxes between zero and the proved points.
  void AddProved(const FrontCurve& curve) {
    std::vector<Point> points = curve.proved;
    std::ranges::sort(points);
    std::string path = fmt::format("M{:.1f} {:.1f}", Frame::left, Frame::bottom);
    double x = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point& point = points[i];
      if (point[0] <= x && i > 0) continue;
      double height = 0;
      for (std::size_t k = i; k < points.size(); ++k) height = std::max(height, points[k][1]);
      path += fmt::format("L{:.1f} {:.1f}", across_.At(x), up_.At(height));
      path += fmt::format("L{:.1f} {:.1f}", across_.At(point[0]), up_.At(height));
      x = point[0];
    }
    path += fmt::format("L{:.1f} {:.1f}Z", across_.At(x), Frame::bottom);
    svg_.Add("path").Set("class", "proved").Set("d", path);
  }

  // Not everything is proved for the union of the quadrants beyond the unproved points.
  void AddUnproved(const FrontCurve& curve) {
    std::vector<Point> points = curve.unproved;
    std::ranges::sort(points);
    if (points.empty()) return;
    std::string path = fmt::format("M{:.1f} {:.1f}", across_.At(points[0][0]), Frame::top);
    double lowest = points[0][1];
    for (const Point& point : points) {
      path += fmt::format("L{:.1f} {:.1f}", across_.At(point[0]), up_.At(lowest));
      lowest = std::min(lowest, point[1]);
      path += fmt::format("L{:.1f} {:.1f}", across_.At(point[0]), up_.At(lowest));
    }
    path += fmt::format("L{:.1f} {:.1f}L{:.1f} {:.1f}Z", Frame::right, up_.At(lowest), Frame::right,
                        Frame::top);
    svg_.Add("path").Set("class", "unproved").Set("d", path);
  }

  // Each curve has its label at another share of its length, so that labels do not overlap.
  void AddLabels() {
    const std::size_t count = picture_.curves.size();
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [label, proved, unproved] = picture_.curves[i];
      if (label.empty() || proved.empty()) continue;
      const Point& at = proved[proved.size() * (i + 1) / (count + 1)];
      AddWords(svg_, "start", across_.At(at[0]) + 4, up_.At(at[1]) - 4, label);
    }
  }

  const FrontPicture& picture_;
  Axis across_;
  Axis up_;
  Element svg_;
};

}  // namespace

Element FrontChart(const FrontPicture& picture) { return Chart(picture).Drawn(); }

}  // namespace assay::report
