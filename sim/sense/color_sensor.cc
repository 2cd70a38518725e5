#include "sim/sense/color_sensor.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "planner/base/check.h"
#include "planner/geometry/hull.h"
#include "sim/render/picture_library.h"
#include "sim/sense/fitting/silhouette.h"

namespace assay::sense {
namespace {

std::vector<ColorFilter> FiltersOf(const std::vector<NamedColor>& colors) {
  std::vector<ColorFilter> filters;
  for (const NamedColor& named : colors) {
    const ColorFilter filter(named.color);
    ASSAY_CHECK(filter.HasHue(), "{} is too grey", named.name);
    ASSAY_CHECK(std::ranges::none_of(filters, [&](const auto& f) { return f.Overlaps(filter); }),
                "{} is like another colour", named.name);
    filters.push_back(filter);
  }
  return filters;
}

// Returns a mask with 255 at pixels where the view shows the solids, and 0 elsewhere.
render::Mask MaskOf(const std::vector<geometry::ConvexHull>& solids, const View& view) {
  render::Mask mask(view.size(), view.size());
  for (const geometry::Polygon& shadow : Shadows(solids, view)) {
    std::vector<std::array<int, 2>> corners;
    for (const Vector2& corner : shadow) {
      corners.push_back({static_cast<int>(corner.x()), static_cast<int>(corner.y())});
    }
    render::Pictures().FillConvexPolygon(corners, 0, mask);
  }
  return mask;
}

// Returns the number of pixels that are set in both masks.
double CommonArea(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus(),
                               [](auto x, auto y) { return x != 0 && y != 0 ? 1 : 0; });
}

}  // namespace

ColorSensor::ColorSensor(const scene::Scene& scene, const domain::Problem& problem,
                         const std::vector<NamedColor>& colors)
    : problem_(problem), eyes_(scene, problem, kWindow), filters_(FiltersOf(colors)) {}

std::vector<double> ColorSensor::Shares(const mujoco::Data& data, PartId part,
                                        const Pose& believed) {
  const std::vector<geometry::ConvexHull> solids =
      Transformed(problem_.part(part).model->pieces(), believed);
  std::vector<double> shares(filters_.size(), 0.0);
  double area = 0;
  for (const Sight& sight : eyes_.LookAt(data, part, believed)) {
    const std::vector<std::uint8_t> mask = MaskOf(solids, sight.view).pixels;
    area += CommonArea(mask, mask);
    for (std::size_t color = 0; color < filters_.size(); ++color) {
      shares[color] += CommonArea(filters_[color].Pass(sight.image), mask);
    }
  }
  for (double& share : shares) share /= area;
  return shares;
}

ColorId ColorSensor::Measure(const mujoco::Data& data, PartId part, const Pose& believed) {
  const std::vector<double> shares = Shares(data, part, believed);
  const auto greatest = std::ranges::max_element(shares);
  const double others = std::accumulate(shares.begin(), shares.end(), -*greatest);
  if (*greatest < kLeastShare || others > kOthersShare) return ColorId::None();
  return ColorId(static_cast<std::size_t>(greatest - shares.begin()));
}

}  // namespace assay::sense
