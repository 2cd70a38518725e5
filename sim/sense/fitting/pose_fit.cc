#include "sim/sense/fitting/pose_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/geometry/hull.h"

namespace assay::sense {
namespace {

constexpr double kSpacing = 3;  // pixels between contour points
// Edges lower than this above the part's lowest point are not used, metres.
constexpr double kHiddenBelow = 0.007;
// The range of the search for edges in each iteration, which is also the scale of the weights,
// pixels.
constexpr std::array<double, 11> kRanges = {14, 12, 10, 8, 6, 5, 4, 3, 2, 2, 2};
constexpr double kLeastDeviation = 0.1;  // pixels

// The distance between an edge and the contour, and the derivative of the contour with respect to
// the displacement of the part.
struct Residual {
  double distance = 0;  // pixels
  Displacement rate;    // the contour's movement along its normal, pixels per metre and per radian
};

struct Residuals {
  std::vector<Residual> found;
  int contour_points = 0;
};

Displacement RateOf(const ContourPoint& point, const View& view, const Vector3& origin) {
  const Eigen::RowVector3d by_point = point.normal.transpose() * view.ProjectionRate(point.p_World);
  Displacement rate;
  rate << by_point.transpose(), by_point.dot(Vector3::UnitZ().cross(point.p_World - origin));
  return rate;
}

Residuals Compare(std::span<const Picture> pictures, const domain::PartModel& model,
                  const Pose& X_WorldPart, double range) {
  Residuals residuals;
  const std::vector<geometry::ConvexHull> solids = Transformed(model.pieces(), X_WorldPart);
  const double least_height = geometry::LowestPoint(solids) + kHiddenBelow;
  for (const Picture& picture : pictures) {
    for (const ContourPoint& point : Contour(solids, picture.view, kSpacing)) {
      if (point.p_World.z() < least_height) continue;
      ++residuals.contour_points;
      const auto distance = FindEdge(picture, point, range);
      if (!distance) continue;
      residuals.found.push_back(
          {*distance, RateOf(point, picture.view, X_WorldPart.translation())});
    }
  }
  return residuals;
}

double TukeyWeight(double distance, double scale) {
  const double ratio = distance / scale;
  return std::abs(ratio) < 1 ? std::pow(1 - ratio * ratio, 2) : 0;
}

struct NormalEquations {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Displacement right = Displacement::Zero();
};

NormalEquations Weighted(const Residuals& residuals, double scale) {
  NormalEquations equations;
  for (const Residual& residual : residuals.found) {
    const double weight = TukeyWeight(residual.distance, scale);
    equations.matrix += weight * residual.rate * residual.rate.transpose();
    equations.right += weight * residual.distance * residual.rate;
  }
  return equations;
}

// Returns a slightly damped Gauss-Newton step. Its units are a millimetre and a hundredth of a
// radian. The damping keeps elements of the displacement unchanged that no edge determines.
Displacement Step(const NormalEquations& equations) {
  const Displacement unit(1e-3, 1e-3, 1e-3, 1e-2);
  const Eigen::Matrix4d scaled = unit.asDiagonal() * equations.matrix * unit.asDiagonal();
  const Eigen::Matrix4d damped = scaled + 0.1 * Eigen::Matrix4d::Identity();
  const Displacement step = damped.ldlt().solve(unit.cwiseProduct(equations.right));
  return unit.cwiseProduct(step);
}

PoseFit Assess(const Residuals& residuals, const Displacement& displacement, double scale) {
  PoseFit fit{.displacement = displacement};
  double squares = 0;
  NormalEquations equations;
  for (const Residual& residual : residuals.found) {
    if (std::abs(residual.distance) >= scale) continue;
    ++fit.edges;
    squares += residual.distance * residual.distance;
    equations.matrix += residual.rate * residual.rate.transpose();
  }
  if (fit.edges == 0) return fit;
  fit.found = static_cast<double>(fit.edges) / residuals.contour_points;
  fit.residual = std::sqrt(squares / fit.edges);
  const double variance = std::pow(std::max(fit.residual, kLeastDeviation), 2);
  const Displacement squared = variance * equations.matrix.inverse().diagonal();
  if (squared.allFinite() && squared.minCoeff() > 0) fit.deviation = squared.cwiseSqrt();
  return fit;
}

}  // namespace

PoseFit FitPose(std::span<const Picture> pictures, const domain::PartModel& model,
                const Pose& believed, const Displacement& start) {
  Displacement displacement = start;
  for (const double range : kRanges) {
    const Residuals residuals = Compare(pictures, model, Displaced(believed, displacement), range);
    displacement += Step(Weighted(residuals, range));
  }
  constexpr double kScale = 1;
  return Assess(Compare(pictures, model, Displaced(believed, displacement), kRanges.back()),
                displacement, kScale);
}

}  // namespace assay::sense
