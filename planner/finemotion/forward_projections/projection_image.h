#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/forward_projections/forward_projection.h"

namespace assay::finemotion {

inline constexpr int kUsualRows = 8;  // the dimension is known to the compiler up to this

// The image of a forward projection under a contact's rows. The rows map a point of generalized
// space to the gap of the contact at this point and to the excess over each limit of the contact.
// In the image the contact is { 0 } x { not positive } x ... . The image has few dimensions,
// however many errors there are. The columns of one matrix hold the start, the motion in the whole
// time, and the change that each error makes to start or motion.
class ProjectionImage {
 public:
  ProjectionImage(const ForwardProjection& projection, const PrimitiveContact& contact);

  // Makes an image without any motion or errors, to be filled in.
  ProjectionImage(Eigen::Index rows, Eigen::Index start_errors, Eigen::Index motion_errors)
      : columns_(Eigen::MatrixXd::Zero(rows, kErrors + start_errors + motion_errors)),
        start_errors_(start_errors),
        motion_errors_(motion_errors) {}

  double& start(Eigen::Index row) { return columns_(row, kStart); }
  double& motion(Eigen::Index row) { return columns_(row, kMotion); }
  double& start_error(Eigen::Index row, Eigen::Index i) { return columns_(row, kErrors + i); }
  double& motion_error(Eigen::Index row, Eigen::Index i) {
    return columns_(row, kErrors + start_errors_ + i);
  }

  Eigen::Index rows() const { return columns_.rows(); }
  Eigen::Index errors() const { return start_errors_ + motion_errors_; }
  bool moves() const;

  // Removes the errors that change nothing in the image. They are the errors of faces that take no
  // part in the contact.
  void ForgetZeros();

 private:
  template <int K>
  friend class ImagePoints;

  static constexpr Eigen::Index kStart = 0;
  static constexpr Eigen::Index kMotion = 1;
  // The column of the first error. The errors of the start come first, then the errors of the
  // motion.
  static constexpr Eigen::Index kErrors = 2;

  const double* Column(Eigen::Index i) const { return columns_.data() + i * rows(); }

  Eigen::MatrixXd columns_;
  Eigen::Index start_errors_;
  Eigen::Index motion_errors_;
};

// The image as points of K dimensions, where the compiler knows K. This class serves the innermost
// loops. Code that uses the points is compiled for each K, so it should be short.
template <int K>
class ImagePoints {
 public:
  using Point = Eigen::Matrix<double, K, 1>;

  explicit ImagePoints(const ProjectionImage& image)
      : image_(image),
        start_(Eigen::Map<const Point>(image.Column(ProjectionImage::kStart), image.rows())),
        motion_(PointAt(ProjectionImage::kMotion)) {}

  const Point& start() const { return start_; }
  const Point& motion() const { return motion_; }
  bool moves() const { return image_.moves(); }
  Eigen::Index start_errors() const { return image_.start_errors_; }
  Eigen::Index errors() const { return image_.errors(); }
  // Returns the change that error i makes. Errors of the start come first, then errors of the
  // motion.
  Eigen::Map<const Point> Error(Eigen::Index i) const {
    return PointAt(ProjectionImage::kErrors + i);
  }

  // Returns a point of the image: along the mean motion, the one nearest to gap 0.
  Point Begin() const {
    if (motion_[0] == 0) return start_;
    return start_ + std::clamp(-start_[0] / motion_[0], 0.0, 1.0) * motion_;
  }

  // Returns the point where a . y is least.
  Point Lowest(const Point& a) const {
    Point lowest = start_;
    AddLowest(a, 0, start_errors(), lowest);
    Point farthest = motion_;
    AddLowest(a, start_errors(), errors(), farthest);
    if (a.dot(farthest) < 0) lowest += farthest;
    return lowest;
  }

 private:
  Eigen::Map<const Point> PointAt(Eigen::Index column) const {
    return {image_.Column(column), start_.size()};
  }

  void AddLowest(const Point& a, Eigen::Index begin, Eigen::Index end, Point& sum) const {
    for (Eigen::Index i = begin; i < end; ++i) {
      const Eigen::Map<const Point> g = Error(i);
      sum -= std::copysign(1.0, a.dot(g)) * g;
    }
  }

  const ProjectionImage& image_;
  Point start_;
  Point motion_;
};

// The exact test and the paper's edge test (meeting.h).
bool Meets(const ProjectionImage& image, double tolerance);
bool EdgeMeets(const ProjectionImage& image);

// Calls `use` with the image's points. The compiler knows their dimension for up to kUsualRows
// rows. Images have more rows only where a face is narrow.
template <int K = 1, class Use>
auto WithPoints(const ProjectionImage& image, const Use& use) {
  if constexpr (K > kUsualRows) {
    return use(ImagePoints<Eigen::Dynamic>(image));
  } else {
    return image.rows() == K ? use(ImagePoints<K>(image)) : WithPoints<K + 1>(image, use);
  }
}

}  // namespace assay::finemotion
