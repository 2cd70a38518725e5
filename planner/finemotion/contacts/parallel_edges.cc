#include "planner/finemotion/contacts/parallel_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/finemotion/forward_projections/meeting.h"
#include "planner/numeric/nearest_point.h"

namespace assay::finemotion {

namespace {

constexpr double kMostDisplacements = 32;  // in displacements; no motion is longer
// The shortest stretch of a motion that is examined, in displacements.
constexpr double kShortest = 0.0625;
constexpr double kNoLength = 1e-12;  // metres; shorter lengths are 0
constexpr int kAlongOther = 2;       // index of the coordinate along the other edge

// A stretch of the motion, in displacements.
struct MotionStretch {
  double begin = 0;
  double end = 0;
};

// The part of an edge that may lie over the other one, as fractions of the edge's length.
struct EdgePart {
  double begin = 0;
  double end = 1;
};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range RangeAlong(const SweptValues<3>& point, const MotionStretch& stretch) {
  const double start_errors = point.start_errors.row(kAlongOther).lpNorm<1>();
  const double motion_errors = point.motion_errors.row(kAlongOther).lpNorm<1>();
  Range range;
  for (const double s : {stretch.begin, stretch.end}) {
    const double mean = point.start[kAlongOther] + s * point.motion[kAlongOther];
    const double errors = start_errors + s * motion_errors;
    range.low = std::min(range.low, mean - errors);
    range.high = std::max(range.high, mean + errors);
  }
  return range;
}

// Restricts the part to where value + slope * fraction >= 0. Returns false if nothing is left.
bool KeepNotNegative(double value, double slope, EdgePart& part) {
  if (slope > kNoLength) part.begin = std::max(part.begin, -value / slope);
  if (slope < -kNoLength) part.end = std::min(part.end, -value / slope);
  return (std::abs(slope) > kNoLength || value >= -kNoLength) && part.begin <= part.end;
}

std::optional<EdgePart> PartOver(const SweptEdge& edge, const MotionStretch& stretch) {
  const Range start = RangeAlong(edge.ends[0], stretch);
  const Range end = RangeAlong(edge.ends[1], stretch);
  EdgePart part;
  if (!KeepNotNegative(start.high + edge.elongation, end.high - start.high, part))
    return std::nullopt;
  if (!KeepNotNegative(edge.length + edge.elongation - start.low, start.low - end.low, part)) {
    return std::nullopt;
  }
  return part;
}

// The convex hull of all positions that the two ends of an edge's part may take in a stretch of the
// motion. It has two coordinates across the other edge. A third coordinate, if there is one, is
// minus the value of `until`: it is positive once the motion has passed that contact.
template <int K>
class Hull {
 public:
  using Point = Eigen::Matrix<double, K, 1>;

  Hull(const SweptEdge& edge, const EdgePart& part, const SweptValues<1>* until,
       const MotionStretch& stretch)
      : ends_{EndOf(edge, part.begin, until), EndOf(edge, part.end, until)}, stretch_(stretch) {}

  Point Begin() const { return ends_[0].start + stretch_.begin * ends_[0].motion; }

  Point Lowest(const Point& a) const {
    double least = std::numeric_limits<double>::infinity();
    Point lowest;
    for (const SweptValues<K>& end : ends_) {
      Point start = end.start;
      AddLowest(a, end.start_errors, start);
      Point motion = end.motion;
      AddLowest(a, end.motion_errors, motion);
      const double s = a.dot(motion) < 0 ? stretch_.end : stretch_.begin;
      const Point point = start + s * motion;
      if (a.dot(point) >= least) continue;
      least = a.dot(point);
      lowest = point;
    }
    return lowest;
  }

 private:
  static SweptValues<K> EndOf(const SweptEdge& edge, double fraction, const SweptValues<1>* until) {
    SweptValues<K> end;
    const auto fill = [&](auto SweptValues<3>::*of, auto SweptValues<1>::*of_until, auto& filled) {
      const auto& first = edge.ends[0].*of;
      const auto& last = edge.ends[1].*of;
      filled.resize(K, first.cols());
      filled.template topRows<2>() =
          (1 - fraction) * first.template topRows<2>() + fraction * last.template topRows<2>();
      if constexpr (K == 3) filled.row(2) = -(until->*of_until);
    };
    fill(&SweptValues<3>::start, &SweptValues<1>::start, end.start);
    fill(&SweptValues<3>::motion, &SweptValues<1>::motion, end.motion);
    fill(&SweptValues<3>::start_errors, &SweptValues<1>::start_errors, end.start_errors);
    fill(&SweptValues<3>::motion_errors, &SweptValues<1>::motion_errors, end.motion_errors);
    return end;
  }

  static void AddLowest(const Point& a, const Eigen::Matrix<double, K, Eigen::Dynamic>& errors,
                        Point& sum) {
    for (Eigen::Index i = 0; i < errors.cols(); ++i) {
      sum -= std::copysign(1.0, a.dot(errors.col(i))) * errors.col(i);
    }
  }

  std::array<SweptValues<K>, 2> ends_;
  MotionStretch stretch_;
};

template <int K>
bool IsApart(const SweptEdge& edge, const EdgePart& part, const SweptValues<1>* until,
             const MotionStretch& stretch) {
  const Hull<K> hull(edge, part, until, stretch);
  return numeric::NearestPoint<K, 2, Hull<K>>(hull, kMeetingTolerance).IsApart();
}

// Returns whether the edges may touch in the stretch, decided for the whole stretch or for each of
// its halves. The bisection is the same for every length of the motion. A longer motion therefore
// has the same stretches, or longer ones, and more of them. So if the edges may touch in a motion,
// they may also touch in every longer motion.
bool MayTouchIn(const SweptEdge& edge, const SweptValues<1>* until, const MotionStretch& stretch,
                double time) {
  const double middle = (stretch.begin + stretch.end) / 2;
  const bool is_short = stretch.end - stretch.begin <= kShortest;
  if (middle >= time && !is_short) {
    return MayTouchIn(edge, until, {stretch.begin, middle}, time);
  }
  const MotionStretch now{stretch.begin, std::min(stretch.end, time)};
  const std::optional<EdgePart> part = PartOver(edge, now);
  if (!part) return false;
  const bool apart =
      until != nullptr ? IsApart<3>(edge, *part, until, now) : IsApart<2>(edge, *part, until, now);
  if (apart) return false;
  return is_short || MayTouchIn(edge, until, {stretch.begin, middle}, time) ||
         MayTouchIn(edge, until, {middle, stretch.end}, time);
}

}  // namespace

ContactKey KeyOf(const ParallelEdges& edges) {
  return {ContactKind::kEdgeEdge, edges.moving, edges.stationary};
}

bool MayTouch(const SweptEdge& edge, const SweptValues<1>* until, double time) {
  return MayTouchIn(edge, until, {0, kMostDisplacements}, time);
}

}  // namespace assay::finemotion
