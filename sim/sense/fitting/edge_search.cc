#include "sim/sense/fitting/edge_search.h"

#include <algorithm>
#include <cmath>

namespace assay::sense {
namespace {

constexpr double kStep = 0.5;  // pixels, along the normal
// Antialiasing and interpolation blur an edge by up to two pixels to each side along a diagonal.
// Farther away, surfaces show their own colour. Both distances are in pixels.
constexpr double kClear = 1.8;
constexpr double kFartherClear = 2.5;
// The greatest colour differences within a surface, on a scale to 255. The first holds while the
// edge is known to one pixel, the second once it is known to a fraction of a pixel.
constexpr double kRoughlyEven = 60;
constexpr double kEven = 12;
constexpr double kLeastContrast = 30;

Vector3 PixelColor(const render::Image& image, int column, int row) {
  column = std::clamp(column, 0, image.width - 1);
  row = std::clamp(row, 0, image.height - 1);
  const std::uint8_t* rgb =
      image.rgb.data() + 3 * (static_cast<std::size_t>(row) * image.width + column);
  return {static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])};
}

// Interpolates bilinearly between the centres of pixels.
Vector3 ColorAt(const render::Image& image, const Vector2& p) {
  const double x = std::floor(p.x() - 0.5);
  const double y = std::floor(p.y() - 0.5);
  const double right = p.x() - 0.5 - x;
  const double down = p.y() - 0.5 - y;
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  return (1 - down) * ((1 - right) * PixelColor(image, column, row) +
                       right * PixelColor(image, column + 1, row)) +
         down * ((1 - right) * PixelColor(image, column, row + 1) +
                 right * PixelColor(image, column + 1, row + 1));
}

// The pixel values of the picture along the outward normal of a contour point. Offsets are in
// pixels.
struct Profile {
  const Picture& picture;
  const ContourPoint& point;

  Vector2 At(double offset) const { return point.pixel + offset * point.normal; }
  Surface SurfaceAt(double offset) const {
    const Vector2 p = At(offset);
    return picture.surfaces.At(p.x(), p.y());
  }
  Vector3 Color(double offset) const { return ColorAt(picture.image, At(offset)); }

  bool EndsAt(double offset) const {
    return SurfaceAt(offset) == Surface::kPart && SurfaceAt(offset + kStep) != Surface::kPart &&
           SurfaceAt(offset - kClear) == Surface::kPart &&
           SurfaceAt(offset + kStep + kClear) == Surface::kTable;
  }
};

// Returns the colour of the surface on one side of an edge: outside for direction 1, inside for -1.
// Returns none if the colour is not even.
std::optional<Vector3> ColorBeside(const Profile& profile, double edge, int direction,
                                   double evenness) {
  const Vector3 near = profile.Color(edge + direction * kClear);
  const Vector3 far = profile.Color(edge + direction * kFartherClear);
  if ((near - far).cwiseAbs().maxCoeff() > evenness) return std::nullopt;
  return (near + far) / 2;
}

// Returns the offset near `edge` where the colour is half way from the part's to the table's.
std::optional<double> Halfway(const Profile& profile, double edge, double evenness) {
  const std::optional<Vector3> inside = ColorBeside(profile, edge, -1, evenness);
  const std::optional<Vector3> outside = ColorBeside(profile, edge, 1, evenness);
  if (!inside || !outside || (*outside - *inside).norm() < kLeastContrast) return std::nullopt;
  const Vector3 axis = (*outside - *inside) / (*outside - *inside).squaredNorm();
  constexpr double kFineStep = 0.25;
  double before = 0;
  for (double t = edge - kClear; t < edge + kClear; t += kFineStep) {
    const double fraction = axis.dot(profile.Color(t) - *inside);
    if (fraction >= 0.5) {
      return t - kFineStep * (fraction - 0.5) / std::max(fraction - before, 1e-9);
    }
    before = fraction;
  }
  return std::nullopt;
}

// Refines the offset of an edge from an accuracy of one pixel to a fraction of a pixel.
std::optional<double> Refined(const Profile& profile, double edge) {
  const std::optional<double> rough = Halfway(profile, edge, kRoughlyEven);
  return rough ? Halfway(profile, *rough, kEven) : std::nullopt;
}

}  // namespace

std::optional<double> FindEdge(const Picture& picture, const ContourPoint& point, double range) {
  const Profile profile{picture, point};
  for (double distance = 0; distance <= range; distance += kStep) {
    for (const double offset : {-distance, distance - kStep}) {
      if (profile.EndsAt(offset)) return Refined(profile, offset + kStep / 2);
    }
  }
  return std::nullopt;
}

}  // namespace assay::sense
