#include "planner/finemotion/meeting.h"

#include "planner/finemotion/nearest_point.h"
#include "planner/finemotion/projection_image.h"

namespace assay::finemotion {

Meeting Meet(const ForwardProjection& projection, const PrimitiveContact& contact,
             double tolerance) {
  CheckDimensions(projection, contact);
  return WithImage(projection, contact, [&]<int K>(ProjectionImage<K> image) {
    image.ForgetZeros();
    const double margin = NearestPoint<K, 1, ProjectionImage<K>>(image, tolerance).Distance();
    return Meeting{.meets = margin == 0, .margin = margin};
  });
}

template <int K>
bool Meets(const ProjectionImage<K>& image, double tolerance) {
  return !NearestPoint<K, 1, ProjectionImage<K>>(image, tolerance).IsApart();
}
template bool Meets<1>(const ProjectionImage<1>&, double);
template bool Meets<2>(const ProjectionImage<2>&, double);
template bool Meets<3>(const ProjectionImage<3>&, double);
template bool Meets<4>(const ProjectionImage<4>&, double);
template bool Meets<5>(const ProjectionImage<5>&, double);
template bool Meets<6>(const ProjectionImage<6>&, double);
template bool Meets<7>(const ProjectionImage<7>&, double);
template bool Meets<8>(const ProjectionImage<8>&, double);
template bool Meets<Eigen::Dynamic>(const ProjectionImage<Eigen::Dynamic>&, double);

}  // namespace assay::finemotion
