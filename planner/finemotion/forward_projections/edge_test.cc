#include <algorithm>
#include <bit>
#include <cstdint>

#include "planner/base/check.h"
#include "planner/finemotion/forward_projections/meeting.h"
#include "planner/finemotion/forward_projections/projection_image.h"

namespace assay::finemotion {

namespace {

// Returns whether some point begin + f along with 0 <= f <= 1 is in the contact.
template <class Point>
bool SegmentMeets(const Point& begin, const Point& along) {
  const double gap = begin[0];
  const double other_gap = gap + along[0];
  if (std::min(gap, other_gap) > kMeetingTolerance || std::max(gap, other_gap) < -kMeetingTolerance)
    return false;
  double least = 0;
  double most = 1;
  const auto keep_below = [&](double value, double slope) {  // requires value + f slope <= 0
    if (slope > 0) most = std::min(most, -value / slope);
    if (slope < 0) least = std::max(least, -value / slope);
    return slope != 0 || value <= 0;
  };
  if (!keep_below(gap - kMeetingTolerance, along[0]) ||
      !keep_below(-gap - kMeetingTolerance, -along[0]))
    return false;
  for (Eigen::Index j = 1; j < begin.size(); ++j) {
    if (!keep_below(begin[j] - kMeetingTolerance, along[j]) || least > most) return false;
  }
  return least <= most;
}

// Errors of an image, from index `begin` up to but without `end`.
struct ErrorRange {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;
};

// Visits each sum of `center` and all errors with a sign, together with the set of errors whose
// sign is positive, until a visit returns true. The signs change one at a time, in the order of a
// Gray code.
template <int K, class Visit>
bool AnyVertex(const ImagePoints<K>& image, const Eigen::Matrix<double, K, 1>& center,
               const ErrorRange& errors, const Visit& visit) {
  Eigen::Matrix<double, K, 1> vertex = center;
  for (Eigen::Index i = errors.begin; i < errors.end; ++i) vertex -= image.Error(i);
  const std::uint64_t count = std::uint64_t{1} << (errors.end - errors.begin);
  std::uint64_t added = 0;
  for (std::uint64_t next = 1;; ++next) {
    if (visit(vertex, added)) return true;
    if (next == count) return false;
    const int i = std::countr_zero(next);
    added ^= std::uint64_t{1} << i;
    vertex += ((added >> i & 1) != 0 ? 2.0 : -2.0) * image.Error(errors.begin + i);
  }
}

// Returns whether an edge along an error meets the contact.
template <int K>
bool EdgeAlongErrorMeets(const ImagePoints<K>& image, const Eigen::Matrix<double, K, 1>& center,
                         const ErrorRange& errors) {
  return AnyVertex(image, center, errors, [&](const auto& vertex, std::uint64_t added) {
    for (Eigen::Index i = errors.begin; i < errors.end; ++i, added >>= 1) {
      if ((added & 1) != 0) continue;
      const Eigen::Matrix<double, K, 1> along = 2.0 * image.Error(i);
      if (SegmentMeets(vertex, along)) return true;
    }
    return false;
  });
}

// Returns whether an edge of the projection meets the contact. There are three kinds of edges: the
// edges of the start, the edges from the start's vertices to the places that they reach, and the
// edges of the region that is reached at the end.
template <int K>
bool AnyEdgeMeets(const ImagePoints<K>& image) {
  const ErrorRange of_start{0, image.start_errors()};
  const ErrorRange of_motion{image.start_errors(), image.errors()};
  if (EdgeAlongErrorMeets(image, image.start(), of_start)) return true;
  const bool is_between = AnyVertex(image, image.start(), of_start, [&](const auto& vertex, auto) {
    return AnyVertex(image, image.motion(), of_motion,
                     [&](const auto& way, auto) { return SegmentMeets(vertex, way); });
  });
  if (is_between || !image.moves()) return is_between;
  return EdgeAlongErrorMeets<K>(image, image.start() + image.motion(), {0, image.errors()});
}

}  // namespace

bool EdgeMeets(const ProjectionImage& image) {
  return WithPoints(image, [](const auto& points) { return AnyEdgeMeets(points); });
}

bool MeetAtAnEdge(const ForwardProjection& projection, const PrimitiveContact& contact) {
  ASSAY_CHECK(projection.start.generators.cols() + projection.velocity.generators.cols() <=
              kMostEdgeTestErrors);
  return EdgeMeets(ProjectionImage(projection, contact));
}

}  // namespace assay::finemotion
