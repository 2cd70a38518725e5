#include "planner/finemotion/meeting.h"

#include <algorithm>
#include <vector>

#include "planner/finemotion/projection_image.h"

namespace assay::finemotion {

namespace {

// The distance of the image from the contact is the least norm in the image + { 0 } x { not
// negative } x ...: found by the algorithm of Wolfe (1976), with rays (the axes) beside points. It
// keeps few of them, the corral, of whose hull it knows the point nearest to 0. The lowest point of
// the image in that direction either certifies the distance or comes in.
template <int K>
class NearestPoint {
 public:
  NearestPoint(const ProjectionImage<K>& image, double tolerance)
      : image_(image),
        tolerance_(tolerance),
        directions_(image.start.size(), image.start.size()),
        triangle_(image.start.size(), image.start.size()),
        projections_(image.start.size()) {
    const ImagePoint<K> begin = NearGapZero();
    corral_.reserve(begin.size() + 2);
    corral_.push_back({begin, 1, Element::kPoint});
    for (int j = 1; j < begin.size(); ++j) {
      if (begin[j] < 0) corral_.push_back({Axis(j), -begin[j], j});
    }
    nearest_ = begin.cwiseMax(0);
    nearest_[0] = begin[0];
  }

  // They meet unless a direction shows that they do not.
  Meeting Find() { return Search(false); }
  // The verdict alone is had earlier.
  bool Meets() { return Search(true).meets; }

 private:
  struct Element {
    static constexpr int kPoint = 0;
    ImagePoint<K> at;
    double weight = 0;  // not negative; those of points sum to 1
    int axis = kPoint;  // of a ray: its axis
    double wanted = 0;  // weight

    bool is_point() const { return axis == kPoint; }
  };

  static constexpr int kMostRounds = 1000;
  static constexpr double kExactness = 0.1;    // of the tolerance
  static constexpr double kDependent = 1e-14;  // sine of an angle

  Meeting Search(bool verdict_only) {
    double lower = 0;  // bound of the distance
    for (int round = 0; round < kMostRounds; ++round) {
      ImagePoint<K> outward = nearest_.cwiseMax(0);
      outward[0] = nearest_[0];
      const double upper = outward.norm();
      if (upper <= tolerance_) return {};
      const ImagePoint<K> lowest = image_.Lowest(outward);
      lower = std::max(lower, outward.dot(lowest) / upper);
      if (upper - lower <= kExactness * tolerance_) break;
      if (verdict_only && lower > tolerance_) break;
      if (!Improve(lowest)) break;
    }
    if (lower <= tolerance_) return {};
    return {.meets = false, .margin = lower};
  }

  ImagePoint<K> Origin() const { return ImagePoint<K>::Zero(image_.start.size()); }
  ImagePoint<K> Axis(int j) const { return ImagePoint<K>::Unit(image_.start.size(), j); }

  // A point of the image: along the mean motion as near to gap 0 as it comes.
  ImagePoint<K> NearGapZero() const {
    if (image_.motion[0] == 0) return image_.start;
    const double s = std::clamp(-image_.start[0] / image_.motion[0], 0.0, 1.0);
    return image_.start + s * image_.motion;
  }

  // Takes in a point that lies nearer to 0 than the corral, and the rays that then lead nearer
  // still. Tells whether it came nearer, which rounding can prevent.
  bool Improve(const ImagePoint<K>& entering) {
    const double before = nearest_.squaredNorm();
    if (!Enter({entering, 0, Element::kPoint})) return false;
    for (int rays = 1; rays < nearest_.size(); ++rays) {
      int axis = 1;
      for (int j = 2; j < nearest_.size(); ++j) axis = nearest_[j] < nearest_[axis] ? j : axis;
      if (nearest_[axis] >= -kExactness * tolerance_ || !Enter({Axis(axis), 0, axis})) break;
    }
    return nearest_.squaredNorm() < before;
  }

  // Wolfe's minor cycle: towards the nearest point of the corral's affine hull; if a weight falls
  // to 0 on the way, its element leaves, and on without it.
  bool Enter(const Element& entering) {
    if (std::ssize(corral_) > nearest_.size()) return false;
    corral_.push_back(entering);
    bool solved = FindWanted();
    while (solved && !StepToWanted()) solved = FindWanted();
    nearest_.setZero();
    for (const Element& element : corral_) nearest_ += element.weight * element.at;
    return solved;
  }

  // Tells whether the wanted weights are reached.
  bool StepToWanted() {
    double step = 1;
    auto leaving = corral_.end();
    for (auto element = corral_.begin(); element != corral_.end(); ++element) {
      if (element->wanted > 0) continue;
      const double reach = element->weight / (element->weight - element->wanted);
      if (leaving != corral_.end() && reach >= step) continue;
      step = reach;
      leaving = element;
    }
    for (Element& element : corral_) element.weight += step * (element.wanted - element.weight);
    if (leaving == corral_.end()) return true;
    corral_.erase(leaving);
    return false;
  }

  // The weights of the point nearest to 0 of the affine hull: least squares in the differences
  // from one of the points, by Gram and Schmidt's method. False if these are dependent.
  bool FindWanted() {
    const auto base = std::ranges::find(corral_, Element::kPoint, &Element::axis);
    ImagePoint<K> rest = -base->at;
    int count = 0;
    for (auto element = corral_.begin(); element != corral_.end(); ++element) {
      if (element == base) continue;
      const ImagePoint<K> origin = element->is_point() ? base->at : Origin();
      if (!Orthogonalize(element->at - origin, count)) return false;
      projections_[count] = directions_.col(count).dot(rest);
      rest -= projections_[count] * directions_.col(count);
      ++count;
    }
    base->wanted = 1;
    for (auto element = corral_.rbegin(); element != corral_.rend(); ++element) {
      if (&*element == &*base) continue;
      --count;
      element->wanted = projections_[count] / triangle_(count, count);
      projections_.head(count) -= element->wanted * triangle_.col(count).head(count);
      if (element->is_point()) base->wanted -= element->wanted;
    }
    return true;
  }

  // difference = directions . triangle.col(count), where the last direction is new. Twice, so that
  // it is orthogonal to the others to rounding.
  bool Orthogonalize(ImagePoint<K> difference, int count) {
    const double length = difference.norm();
    triangle_.col(count).setZero();
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count; ++i) {
        const double along = directions_.col(i).dot(difference);
        triangle_(i, count) += along;
        difference -= along * directions_.col(i);
      }
    }
    triangle_(count, count) = difference.norm();
    directions_.col(count) = difference / triangle_(count, count);
    return triangle_(count, count) > kDependent * length;
  }

  const ProjectionImage<K>& image_;
  double tolerance_;
  ImagePoint<K> nearest_;
  std::vector<Element> corral_;
  // Of FindWanted.
  Eigen::Matrix<double, K, K> directions_;
  Eigen::Matrix<double, K, K> triangle_;
  ImagePoint<K> projections_;
};

}  // namespace

Meeting Meet(const ForwardProjection& projection, const PrimitiveContact& contact,
             double tolerance) {
  CheckDimensions(projection, contact);
  return WithImage(projection, contact, [&]<int K>(ProjectionImage<K> image) {
    image.ForgetZeros();
    return NearestPoint<K>(image, tolerance).Find();
  });
}

template <int K>
bool Meets(const ProjectionImage<K>& image, double tolerance) {
  return NearestPoint<K>(image, tolerance).Meets();
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
