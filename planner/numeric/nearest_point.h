#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

namespace assay::numeric {

// Computes the distance of a convex set from 0. In the coordinates from kEqual on, only positive
// values count. The distance is thus the least norm in the set + { 0 } x { not negative } x ... .
// The algorithm is Wolfe's (1976), with rays (the axes) beside points. It keeps a few points and
// rays, called the corral, and knows the point of their hull nearest to 0. The lowest point of the
// set in the direction of that point either certifies the distance or enters the corral. A Set has
// two functions: Begin() returns a point of it, and Lowest(a) one where a . y is least.
template <int K, int kEqual, class Set>
class NearestPoint {
 public:
  using Point = Eigen::Matrix<double, K, 1>;

  NearestPoint(const Set& set, double tolerance) : NearestPoint(set, tolerance, set.Begin()) {}

  // Returns a lower bound of the distance, exact to a tenth of the tolerance. It returns 0 unless
  // the set is known to be farther away than the tolerance.
  double Distance() { return Search(false); }
  // Returns whether the distance exceeds the tolerance. It stops earlier than Distance.
  bool IsApart() { return Search(true) > 0; }

 private:
  NearestPoint(const Set& set, double tolerance, const Point& begin)
      : set_(set),
        tolerance_(tolerance),
        triangle_(begin.size(), begin.size()),
        projections_(begin.size()) {
    if constexpr (K == Eigen::Dynamic) directions_.resize(begin.size());
    nearest_ = Outward(begin);
    corral_.reserve(begin.size() + 2);
    corral_.push_back({begin, 1, Element::kPoint});
    for (int j = kEqual; j < begin.size(); ++j) {
      if (begin[j] < 0) corral_.push_back({Axis(j), -begin[j], j});
    }
  }

  // Returns the point with 0 in place of each negative coordinate from kEqual on, because only
  // positive values of these coordinates count for the distance.
  static Point Outward(const Point& at) {
    Point outward = at;
    for (Eigen::Index j = kEqual; j < at.size(); ++j) outward[j] = std::max(at[j], 0.0);
    return outward;
  }

  struct Element {
    static constexpr int kPoint = 0;
    Point at;
    double weight = 0;  // not negative; the weights of points sum to 1
    int axis = kPoint;  // for a ray, the index of its axis
    double wanted = 0;  // the weight to which StepToWanted moves

    bool is_point() const { return axis == kPoint; }
  };

  static constexpr int kMostRounds = 1000;
  // Fraction of the tolerance to which the distance is exact.
  static constexpr double kExactness = 0.1;
  // Sine of an angle below which directions are dependent.
  static constexpr double kDependent = 1e-14;

  double Search(bool verdict_only) {
    double lower = 0;  // lower bound of the distance
    for (int round = 0; round < kMostRounds; ++round) {
      const Point outward = Outward(nearest_);
      const double upper = outward.norm();
      if (upper <= tolerance_) return 0;
      const Point lowest = set_.Lowest(outward);
      lower = std::max(lower, outward.dot(lowest) / upper);
      if (upper - lower <= kExactness * tolerance_) break;
      if (verdict_only && lower > tolerance_) break;
      if (!Improve(lowest)) break;
    }
    return lower <= tolerance_ ? 0 : lower;
  }

  Point Origin() const { return Point::Zero(nearest_.size()); }
  Point Axis(int j) const {
    Point axis = Origin();
    axis[j] = 1;
    return axis;
  }

  // Adds a point nearer to 0 than the corral, then any rays that lead nearer still. Returns whether
  // the distance fell, which rounding can prevent.
  bool Improve(const Point& entering) {
    const double before = nearest_.squaredNorm();
    if (!Enter({entering, 0, Element::kPoint})) return false;
    for (int rays = kEqual; rays < nearest_.size(); ++rays) {
      int axis = kEqual;
      for (int j = kEqual + 1; j < nearest_.size(); ++j)
        axis = nearest_[j] < nearest_[axis] ? j : axis;
      if (nearest_[axis] >= -kExactness * tolerance_ || !Enter({Axis(axis), 0, axis})) break;
    }
    return nearest_.squaredNorm() < before;
  }

  // Wolfe's minor cycle. It moves towards the nearest point of the corral's affine hull. If a
  // weight falls to 0 on the way, its element leaves, and the cycle continues without that element.
  bool Enter(const Element& entering) {
    if (std::ssize(corral_) > nearest_.size()) return false;
    corral_.push_back(entering);
    bool solved = FindWanted();
    while (solved && !StepToWanted()) solved = FindWanted();
    nearest_.setZero();
    for (const Element& element : corral_) nearest_ += element.weight * element.at;
    return solved;
  }

  // Returns whether the wanted weights are reached.
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

  // Computes the weights of the affine hull's point nearest to 0, by least squares in the
  // differences from one of the points (Gram and Schmidt's method). Returns false if these
  // differences are dependent.
  bool FindWanted() {
    const auto base = std::ranges::find(corral_, Element::kPoint, &Element::axis);
    Point rest = -base->at;
    int count = 0;
    for (auto element = corral_.begin(); element != corral_.end(); ++element) {
      if (element == base) continue;
      const Point origin = element->is_point() ? base->at : Origin();
      if (!Orthogonalize(element->at - origin, count)) return false;
      projections_[count] = Direction(count).dot(rest);
      rest -= projections_[count] * Direction(count);
      ++count;
    }
    base->wanted = 1;
    for (auto element = corral_.rbegin(); element != corral_.rend(); ++element) {
      if (&*element == &*base) continue;
      --count;
      element->wanted = projections_[count] / triangle_(count, count);
      for (int i = 0; i < count; ++i) projections_[i] -= element->wanted * triangle_(i, count);
      if (element->is_point()) base->wanted -= element->wanted;
    }
    return true;
  }

  // Writes the difference as directions . triangle.col(count), where the last direction is new. Two
  // passes make the new direction orthogonal to the others up to rounding.
  bool Orthogonalize(Point difference, int count) {
    const double length = difference.norm();
    for (int i = 0; i < count; ++i) triangle_(i, count) = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count; ++i) {
        const double along = Direction(i).dot(difference);
        triangle_(i, count) += along;
        difference -= along * Direction(i);
      }
    }
    triangle_(count, count) = difference.norm();
    Direction(count) = difference / triangle_(count, count);
    return triangle_(count, count) > kDependent * length;
  }

  Point& Direction(int i) { return directions_[static_cast<std::size_t>(i)]; }

  const Set& set_;
  double tolerance_;
  Point nearest_;
  std::vector<Element> corral_;
  // Work space of FindWanted, as an array of points: a column of a matrix would add one more Eigen
  // type for each K.
  std::conditional_t<K == Eigen::Dynamic, std::vector<Point>, std::array<Point, std::max(K, 1)>>
      directions_;
  Eigen::Matrix<double, K, K> triangle_;
  Point projections_;
};

}  // namespace assay::numeric
