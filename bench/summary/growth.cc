#include "bench/summary/growth.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace assay::bench {
namespace {

struct SizedName {
  std::string name;
  std::string of;
  double size = 0;
};

bool IsNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// Returns the size in "12" or "sides:12". A seed is no size.
std::optional<double> SizeIn(const std::string& argument) {
  const std::size_t colon = argument.find(':');
  const std::string number = colon == std::string::npos ? argument : argument.substr(colon + 1);
  const std::string name = argument.substr(0, argument.size() - number.size());
  if (!IsNumber(number) || name == "seed:") return std::nullopt;
  return std::stod(number);
}

// Returns a benchmark's name and size. A contestant's size is a counter, since its name
// "family/kind/contestant" ends with the contestant.
std::optional<SizedName> SizedNameOf(const Series& series) {
  const std::size_t last = series.name.rfind('/');
  if (last == std::string::npos) return std::nullopt;
  const std::string end = series.name.substr(last + 1);
  if (const std::optional<double> size = SizeIn(end)) {
    const std::size_t colon = end.find(':');
    return SizedName{series.name.substr(0, last),
                     colon == std::string::npos ? "" : end.substr(0, colon), *size};
  }
  const auto counted = series.counters.find("size");
  if (counted == series.counters.end()) return std::nullopt;
  return SizedName{KindOf(series.name.substr(0, last)) + "/" + end, "", counted->second};
}

// Merges points of one size into their mean in logarithms.
void Merge(std::vector<Growth::Point>& points) {
  std::ranges::sort(points, {}, &Growth::Point::size);
  std::vector<Growth::Point> merged;
  for (std::size_t i = 0; i < points.size();) {
    double sum = 0;
    std::size_t end = i;
    for (; end < points.size() && points[end].size == points[i].size; ++end) {
      sum += std::log(points[end].seconds);
    }
    merged.push_back({points[i].size, std::exp(sum / static_cast<double>(end - i))});
    i = end;
  }
  points = std::move(merged);
}

}  // namespace

double Growth::Exponent() const {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& point : points) {
    const double log_size = std::log(point.size);
    const double log_time = std::log(point.seconds);
    x += log_size;
    y += log_time;
    xx += log_size * log_size;
    xy += log_size * log_time;
  }
  const double n = static_cast<double>(points.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

std::vector<Growth> Growths(const Measurements& measurements) {
  std::vector<Growth> growths;
  for (const Series& series : measurements.series) {
    const std::optional<SizedName> sized = SizedNameOf(series);
    if (!sized || sized->size <= 0 || series.seconds.empty()) continue;
    auto known = std::ranges::find_if(growths, [&](const Growth& growth) {
      return growth.program == series.program && growth.name == sized->name;
    });
    if (known == growths.end()) {
      known = growths.insert(
          known, {.program = series.program, .name = sized->name, .of = sized->of, .points = {}});
    }
    known->points.push_back({sized->size, series.Median()});
  }
  for (Growth& growth : growths) Merge(growth.points);
  std::erase_if(growths, [](const Growth& growth) { return growth.points.size() < 3; });
  return growths;
}

}  // namespace assay::bench
