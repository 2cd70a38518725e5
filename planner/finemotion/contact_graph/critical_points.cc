#include "planner/finemotion/contact_graph/critical_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "planner/base/check.h"
#include "planner/geometry/polygon.h"

namespace assay::finemotion {
namespace {

using geometry::Polygon;
using geometry::Vector2;

constexpr double kSlideTolerance = 1e-6;  // metres

// A stretch of the travel, in metres.
struct TravelStretch {
  double from = 0;
  double to = 0;
};

// A pair of faces, and the stretch of the travel in which they touch: where one slides along the
// other, or where it lands on the other.
struct Touch {
  TouchingFaces faces;
  TravelStretch where;
};

// Coordinates in a plane.
struct Axes {
  Vector3 x, y;

  Vector2 Flat(const Vector3& p) const { return {x.dot(p), y.dot(p)}; }
};

// Returns the hull of all b - a of the two polygons. They overlap when the first polygon is moved
// by a point inside this hull.
Polygon Differences(const std::vector<Vector3>& a, const std::vector<Vector3>& b,
                    const Axes& axes) {
  std::vector<Vector2> points;
  for (const Vector3& p : a) {
    for (const Vector3& q : b) points.push_back(axes.Flat(q - p));
  }
  return geometry::Hull2(points);
}

// Returns the stretch of the x axis that is inside the polygon, deeper than the tolerance.
std::optional<TravelStretch> OnXAxis(const Polygon& polygon) {
  double low = -std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& a = polygon[i];
    const Vector2 along = (polygon[(i + 1) % polygon.size()] - a).normalized();
    // (s, 0) is left of the edge: along.x (0 - a.y) - along.y (s - a.x) >= 0.
    const double depth = along.y() * a.x() - along.x() * a.y();
    if (std::abs(along.y()) < kSameDirection) {
      if (depth < kSlideTolerance) return std::nullopt;
    } else if (along.y() > 0) {
      high = std::min(high, depth / along.y());
    } else {
      low = std::max(low, depth / along.y());
    }
  }
  if (polygon.size() < 3 || high - low < kSlideTolerance) return std::nullopt;
  return TravelStretch{low, high};
}

// Unites stretches that meet. Such stretches are separated only by a seam in a face, which a part
// does not touch.
std::vector<TravelStretch> United(std::vector<TravelStretch> stretches) {
  std::ranges::sort(stretches, {}, &TravelStretch::from);
  std::vector<TravelStretch> united;
  for (const TravelStretch& next : stretches) {
    if (united.empty() || next.from > united.back().to + kSlideTolerance) {
      united.push_back(next);
    } else {
      united.back().to = std::max(united.back().to, next.to);
    }
  }
  return united;
}

class Slide {
 public:
  Slide(const Polyhedron& moving, const Polyhedron& stationary, const Pose& X_StationaryEnd,
        const Vector3& mating_vector, double play)
      : moving_(moving),
        stationary_(stationary),
        X_StationaryEnd_(X_StationaryEnd),
        length_(mating_vector.norm()),
        play_(play),
        direction_(mating_vector / length_) {
    ASSAY_CHECK(length_ > kSlideTolerance);
    for (std::size_t i = 0; i < moving.faces.size(); ++i) {
      for (std::size_t j = 0; j < stationary.faces.size(); ++j) {
        if (moving.faces[i].is_round && stationary.faces[j].is_round) continue;
        AddTouches({static_cast<int>(i), static_cast<int>(j)});
      }
    }
    for (std::size_t i = 0; i < moving.shafts.size(); ++i) {
      for (std::size_t j = 0; j < stationary.holes.size(); ++j) AddRoundTouches(i, j);
    }
  }

  std::vector<CriticalPoint> CriticalPoints() const {
    std::vector<CriticalPoint> points;
    const std::vector<double> changes = Changes();
    std::vector<TouchingFaces> before;
    if (!changes.empty() && changes[0] > kSlideTolerance) before = TouchingAt(changes[0] / 2);
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const double travel = changes[i];
      const bool is_last = i + 1 == changes.size();
      std::vector<TouchingFaces> after =
          TouchingAt(is_last ? travel : (travel + changes[i + 1]) / 2);
      const std::vector<TouchingFaces> here = TouchingAt(travel);
      const bool lands = std::ranges::any_of(here, [&](const TouchingFaces& faces) {
        return !std::ranges::binary_search(before, faces);
      });
      if (after != before || lands) points.push_back({travel, PoseAt(travel), before, after});
      before = std::move(after);
    }
    return points;
  }

 private:
  // Returns the moving part's pose. At full travel it is at its end.
  Pose PoseAt(double travel) const {
    Pose X = X_StationaryEnd_;
    X.translation() -= (length_ - travel) * direction_;
    return X;
  }

  void AddTouches(const TouchingFaces& faces) {
    const OuterFace& face = moving_.faces[static_cast<std::size_t>(faces.moving)];
    const OuterFace& other = stationary_.faces[static_cast<std::size_t>(faces.stationary)];
    const Vector3 normal = X_StationaryEnd_.linear() * face.normal;
    if (normal.dot(other.normal) > 0 || normal.cross(other.normal).norm() > kSameDirection) return;
    const double height_at_end = -face.height - normal.dot(X_StationaryEnd_.translation());
    const double gap_at_end = height_at_end - other.height;
    const double fall = -other.normal.dot(direction_);
    if (std::abs(fall) <= kSameDirection) {
      if (gap_at_end >= -kSlideTolerance && gap_at_end <= play_ + kSlideTolerance)
        AddSliding(faces, Overlaps(face, other));
    } else {
      AddLanding(faces, length_ + gap_at_end / fall, Overlaps(face, other));
    }
  }

  // Adds a round shaft on the axis of a round hole, which touches it from the mouth on. Indices of
  // shafts and holes follow those of faces.
  void AddRoundTouches(std::size_t shaft, std::size_t hole) {
    const RoundHole& around = stationary_.holes[hole];
    const Vector3 tip = X_StationaryEnd_ * moving_.shafts[shaft].tip;
    const double inside = around.axis.dot(around.mouth - tip);
    const Vector3 beside = tip - around.mouth + inside * around.axis;
    if (inside < 0 || beside.norm() > around.radius) return;
    const int of_shaft = static_cast<int>(moving_.faces.size() + shaft);
    const int of_hole = static_cast<int>(stationary_.faces.size() + hole);
    AddSliding({of_shaft, of_hole}, {{length_ - inside, 2 * length_}});
  }

  // Returns the stretches of travel in which the faces, moved into one plane, have an area in
  // common.
  std::vector<TravelStretch> Overlaps(const OuterFace& face, const OuterFace& other) const {
    const Vector3 along = direction_ - other.normal.dot(direction_) * other.normal;
    const Vector3 x = along.norm() > kSameDirection ? Vector3(along.normalized())
                                                    : Vector3(other.normal.unitOrthogonal());
    const Axes axes = {x, other.normal.cross(x)};
    const double pace = axes.x.dot(direction_);  // metres in the plane for one metre of travel
    std::vector<TravelStretch> stretches;
    for (const std::vector<Vector3>& outline : face.region) {
      std::vector<Vector3> start;
      for (const Vector3& corner : outline) start.push_back(PoseAt(0) * corner);
      for (const std::vector<Vector3>& region : other.region) {
        const auto inside = OnXAxis(Differences(start, region, axes));
        if (inside) stretches.push_back(OfTravel(*inside, pace));
      }
    }
    return United(std::move(stretches));
  }

  // Converts a stretch in the plane to one of travel. A face that comes straight down on the other
  // is over it all the way or never.
  TravelStretch OfTravel(const TravelStretch& in_plane, double pace) const {
    if (pace > kSameDirection) return {in_plane.from / pace, in_plane.to / pace};
    const bool over = in_plane.from < 0 && in_plane.to > 0;
    return over ? TravelStretch{0, length_} : TravelStretch{length_ + 1, length_ + 1};
  }

  void AddSliding(const TouchingFaces& faces, const std::vector<TravelStretch>& stretches) {
    for (const TravelStretch& stretch : stretches) touches_.push_back({faces, stretch});
  }

  void AddLanding(const TouchingFaces& faces, double travel,
                  const std::vector<TravelStretch>& stretches) {
    for (const TravelStretch& stretch : stretches) {
      if (stretch.from < travel + kSlideTolerance && travel < stretch.to + kSlideTolerance) {
        touches_.push_back({faces, {travel, travel}});
      }
    }
  }

  // Returns the places where touches begin or end, each once.
  std::vector<double> Changes() const {
    std::vector<double> changes;
    for (const Touch& touch : touches_) {
      for (const double travel : {touch.where.from, touch.where.to}) {
        if (travel > -kSlideTolerance && travel < length_ + kSlideTolerance)
          changes.push_back(travel);
      }
    }
    std::ranges::sort(changes);
    const auto same = [&](double a, double b) { return b - a <= kSlideTolerance; };
    changes.erase(std::unique(changes.begin(), changes.end(), same), changes.end());
    return changes;
  }

  std::vector<TouchingFaces> TouchingAt(double travel) const {
    std::vector<TouchingFaces> touching;
    for (const Touch& touch : touches_) {
      if (touch.where.from <= travel + kSlideTolerance &&
          travel <= touch.where.to + kSlideTolerance) {
        touching.push_back(touch.faces);
      }
    }
    std::ranges::sort(touching);
    touching.erase(std::ranges::unique(touching).begin(), touching.end());
    return touching;
  }

  const Polyhedron& moving_;
  const Polyhedron& stationary_;
  const Pose X_StationaryEnd_;
  const double length_;
  const double play_;
  const Vector3 direction_;
  std::vector<Touch> touches_;
};

}  // namespace

std::vector<CriticalPoint> CriticalPoints(const Polyhedron& moving, const Polyhedron& stationary,
                                          const Pose& X_StationaryEnd, const Vector3& mating_vector,
                                          double play) {
  return Slide(moving, stationary, X_StationaryEnd, mating_vector, play).CriticalPoints();
}

}  // namespace assay::finemotion
