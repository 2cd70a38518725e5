#include "sim/sense/fitting/placement_search.h"

#include <array>
#include <cmath>
#include <limits>

#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/render/picture_library.h"

namespace assay::sense {
namespace {

constexpr int kCell = 6;  // pixels along each side of a cell
constexpr double kGridStep = 0.002;
constexpr double kYawStep = 0.035;
constexpr int kForPart = 2;  // the score of a silhouette for covering a cell
constexpr int kForTable = -1;

struct Cell {
  int row = 0;
  int column = 0;
};

// The score that a silhouette gets for covering each cell of a picture.
class WorthMap {
 public:
  explicit WorthMap(const SurfaceMap& map) : side_(map.size / kCell), worth_(side_ * side_) {
    for (int row = 0; row < side_; ++row) {
      for (int column = 0; column < side_; ++column) {
        worth_[row * side_ + column] = WorthOf(map.At((column + 0.5) * kCell, (row + 0.5) * kCell));
      }
    }
  }

  int side() const { return side_; }
  int Sum(const std::vector<Cell>& cells, const Cell& shift) const {
    int sum = 0;
    for (const Cell& cell : cells) {
      const int row = cell.row + shift.row;
      const int column = cell.column + shift.column;
      if (row < 0 || column < 0 || row >= side_ || column >= side_) continue;
      sum += worth_[row * side_ + column];
    }
    return sum;
  }

 private:
  static int WorthOf(Surface surface) {
    switch (surface) {
      case Surface::kPart:
        return kForPart;
      case Surface::kTable:
        return kForTable;
      case Surface::kElse:
      case Surface::kOtherPart:
        return 0;
    }
    return 0;
  }

  int side_;
  std::vector<int> worth_;
};

// Returns the cells whose centres the silhouette covers.
std::vector<Cell> Silhouette(std::span<const geometry::ConvexHull> solids, const View& view,
                             int side) {
  constexpr int kFractionBits = 4;
  constexpr double kFractions = 1 << kFractionBits;
  render::Mask picture(side, side);
  for (const geometry::Polygon& outline : Shadows(solids, view)) {
    std::vector<std::array<int, 2>> corners;
    for (const Vector2& corner : outline) {
      const Vector2 cell = (corner / kCell - Vector2(0.5, 0.5)) * kFractions;
      corners.push_back(
          {static_cast<int>(std::lround(cell.x())), static_cast<int>(std::lround(cell.y()))});
    }
    render::Pictures().FillConvexPolygon(corners, kFractionBits, picture);
  }
  std::vector<Cell> cells;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      if (picture.pixels[row * side + column] != 0) cells.push_back({row, column});
    }
  }
  return cells;
}

// The data of one camera (eye) for the search.
struct Eye {
  WorthMap worth;
  Eigen::Matrix2d cells_per_metre;  // the picture's movement with the part's x and y
};

// Returns the grid points 0, +1, -1, +2, ... times `step` up to `last`. This order lets the nearest
// point win among points of equal score.
std::vector<double> Outward(double step, double last) {
  std::vector<double> points = {0};
  for (double p = step; p <= last; p += step) {
    points.push_back(p);
    points.push_back(-p);
  }
  return points;
}

int Score(const std::vector<Eye>& eyes, const std::vector<std::vector<Cell>>& silhouettes,
          const Vector2& moved) {
  int score = 0;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const Vector2 shift = eyes[i].cells_per_metre * moved;
    score += eyes[i].worth.Sum(silhouettes[i], {static_cast<int>(std::lround(shift.y())),
                                                static_cast<int>(std::lround(shift.x()))});
  }
  return score;
}

}  // namespace

Displacement CoarsePlacement(std::span<const Picture> pictures, const domain::PartModel& model,
                             const Pose& believed, const SearchWindow& window) {
  std::vector<Eye> eyes;
  const Vector3 center = believed * model.mass().center;
  for (const Picture& picture : pictures) {
    eyes.push_back(
        {WorthMap(picture.surfaces), picture.view.ProjectionRate(center).leftCols<2>() / kCell});
  }
  Displacement best = Displacement::Zero();
  int best_score = std::numeric_limits<int>::min();
  for (const double yaw : Outward(kYawStep, window.yaw)) {
    const auto solids = Transformed(model.pieces(), Displaced(believed, {0, 0, 0, yaw}));
    std::vector<std::vector<Cell>> silhouettes;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
      silhouettes.push_back(Silhouette(solids, pictures[i].view, eyes[i].worth.side()));
    }
    for (const double x : Outward(kGridStep, window.distance)) {
      for (const double y : Outward(kGridStep, window.distance)) {
        const int score = Score(eyes, silhouettes, {x, y});
        if (score <= best_score) continue;
        best_score = score;
        best = {x, y, 0, yaw};
      }
    }
  }
  return best;
}

}  // namespace assay::sense
