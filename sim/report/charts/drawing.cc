#include "sim/report/charts/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace assay::report {

Element Drawing(double width, double height, const std::string& words) {
  Element svg("svg");
  svg.Set("class", "chart").Set("width", width).Set("height", height);
  svg.Set("viewBox", fmt::format("0 0 {} {}", width, height));
  svg.Set("role", "img").Set("aria-label", words);
  return svg;
}

void AddLine(Element& svg, std::string_view kind, double x1, double y1, double x2, double y2) {
  svg.Add("line").Set("class", kind).Set("x1", x1).Set("y1", y1).Set("x2", x2).Set("y2", y2);
}

void AddBox(Element& svg, std::string_view kind, double x, double y, double width, double height) {
  svg.Add("rect")
      .Set("class", kind)
      .Set("x", x)
      .Set("y", y)
      .Set("width", width)
      .Set("height", height);
}

void AddWords(Element& svg, std::string_view anchor, double x, double y, std::string_view words) {
  svg.Add("text", words).Set("text-anchor", anchor).Set("x", x).Set("y", y);
}

double Axis::At(double value) const {
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return left + share * (right - left);
}

std::vector<double> Ticks(const Axis& axis, int most) {
  const double rough = (axis.high - axis.low) / most;
  double step = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {2.0, 2.5, 2.0}) {
    if ((axis.high - axis.low) / step <= most) break;
    step *= factor;
  }
  std::vector<double> ticks;
  const double first = std::ceil(axis.low / step);
  for (double k = first; k * step <= axis.high * (1 + 1e-12) + 1e-300; ++k)
    ticks.push_back(k * step);
  return ticks;
}

}  // namespace assay::report
