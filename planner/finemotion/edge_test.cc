#include <algorithm>
#include <bit>
#include <cstdint>

#include "planner/base/check.h"
#include "planner/finemotion/meeting.h"
#include "planner/finemotion/projection_image.h"

namespace assay::finemotion {

namespace {

// Whether a point begin + f along, 0 <= f <= 1, is in the contact.
template <int K>
bool SegmentMeets(const ImagePoint<K>& begin, const ImagePoint<K>& along) {
  const double gap = begin[0];
  const double other_gap = gap + along[0];
  if (std::min(gap, other_gap) > kMeetingTolerance || std::max(gap, other_gap) < -kMeetingTolerance)
    return false;
  double least = 0;
  double most = 1;
  const auto keep_below = [&](double value, double slope) {  // value + f slope <= 0
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

// Visits center +- each generator, with the set of generators that are added, until a visit says
// that it is enough; in the order of Gray's code, in which one sign changes at a time.
template <int K, class Visit>
bool AnyVertex(const ImagePoint<K>& center, const ImagePoints<K>& generators, const Visit& visit) {
  ImagePoint<K> vertex = center - generators.rowwise().sum();
  const std::uint64_t count = std::uint64_t{1} << generators.cols();
  std::uint64_t added = 0;
  for (std::uint64_t next = 1;; ++next) {
    if (visit(vertex, added)) return true;
    if (next == count) return false;
    const int i = std::countr_zero(next);
    added ^= std::uint64_t{1} << i;
    vertex += ((added >> i & 1) != 0 ? 2 : -2) * generators.col(i);
  }
}

// Whether an edge along a generator meets the contact that begins at this vertex.
template <int K>
bool EdgeFromVertexMeets(const ImagePoint<K>& vertex, std::uint64_t added,
                         const ImagePoints<K>& generators) {
  for (Eigen::Index i = 0; i < generators.cols(); ++i) {
    if ((added >> i & 1) == 0 && SegmentMeets<K>(vertex, 2 * generators.col(i))) return true;
  }
  return false;
}

template <int K>
bool EdgeAlongGeneratorMeets(const ImagePoint<K>& center, const ImagePoints<K>& generators) {
  return AnyVertex<K>(center, generators, [&](const auto& vertex, auto added) {
    return EdgeFromVertexMeets<K>(vertex, added, generators);
  });
}

}  // namespace

// Edges of the start, from its vertices to where they move to, and of what has moved for the whole
// time.
template <int K>
bool EdgeMeets(const ProjectionImage<K>& image) {
  const ImagePoints<K>& near = image.start_generators;
  if (EdgeAlongGeneratorMeets<K>(image.start, near)) return true;
  const bool is_between = AnyVertex<K>(image.start, near, [&](const auto& vertex, auto) {
    return AnyVertex<K>(image.motion, image.motion_generators,
                        [&](const auto& way, auto) { return SegmentMeets<K>(vertex, way); });
  });
  if (is_between || !image.moves()) return is_between;
  ImagePoints<K> far(near.rows(), near.cols() + image.motion_generators.cols());
  far << near, image.motion_generators;
  return EdgeAlongGeneratorMeets<K>(image.start + image.motion, far);
}
template bool EdgeMeets<1>(const ProjectionImage<1>&);
template bool EdgeMeets<2>(const ProjectionImage<2>&);
template bool EdgeMeets<3>(const ProjectionImage<3>&);
template bool EdgeMeets<4>(const ProjectionImage<4>&);
template bool EdgeMeets<5>(const ProjectionImage<5>&);
template bool EdgeMeets<6>(const ProjectionImage<6>&);
template bool EdgeMeets<7>(const ProjectionImage<7>&);
template bool EdgeMeets<8>(const ProjectionImage<8>&);
template bool EdgeMeets<Eigen::Dynamic>(const ProjectionImage<Eigen::Dynamic>&);

bool MeetAtAnEdge(const ForwardProjection& projection, const PrimitiveContact& contact) {
  CheckDimensions(projection, contact);
  ASSAY_CHECK(projection.start.generators.cols() + projection.velocity.generators.cols() <=
              kMostEdgeTestErrors);
  return WithImage(projection, contact,
                   []<int K>(const ProjectionImage<K>& image) { return EdgeMeets(image); });
}

}  // namespace assay::finemotion
