#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/check.h"
#include "planner/finemotion/forward_projection.h"

namespace assay::finemotion {

inline constexpr int kUsualRows = 8;  // at most: more where a face is narrow

// Where a contact's rows take a point of generalized space to: its gap and its excess over each
// limit, K numbers. There the contact is { 0 } x { not positive } x ..., in few dimensions however
// many errors there are.
template <int K>
using ImagePoint = Eigen::Matrix<double, K, 1>;
template <int K>
using ImagePoints = Eigen::Matrix<double, K, Eigen::Dynamic>;

// The rows, without the coordinates that none of them reads (most tolerances are of other faces).
template <int K>
struct ContactRows {
  std::vector<Eigen::Index> coordinates;
  ImagePoints<K> columns;  // one for each of the coordinates
  ImagePoint<K> offset;

  explicit ContactRows(const PrimitiveContact& contact) {
    const Eigen::Index n = contact.row.size();
    offset.resize(1 + std::ssize(contact.limits));
    const Eigen::Index k = offset.size();  // known to the compiler, where K is
    columns.resize(k, n);
    offset[0] = contact.offset;
    for (Eigen::Index j = 1; j < k; ++j) offset[j] = -contact.limits[j - 1].b;
    coordinates.reserve(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      auto column = columns.col(std::ssize(coordinates));
      column[0] = contact.row[i];
      for (Eigen::Index j = 1; j < k; ++j) column[j] = contact.limits[j - 1].a[i];
      if (!column.isZero(0)) coordinates.push_back(i);
    }
  }

  template <class Vector>
  ImagePoint<K> Image(const Vector& direction) const {
    ImagePoint<K> image = ImagePoint<K>::Zero(offset.size());
    for (Eigen::Index i = 0; i < std::ssize(coordinates); ++i) {
      const double value = direction[coordinates[i]];
      if (value != 0) image += value * columns.col(i);
    }
    return image;
  }

  ImagePoints<K> Images(const Eigen::MatrixXd& directions) const {
    ImagePoints<K> images(offset.size(), directions.cols());
    for (Eigen::Index i = 0; i < directions.cols(); ++i) images.col(i) = Image(directions.col(i));
    return images;
  }
};

// The image of a projection.
template <int K>
struct ProjectionImage {
  ImagePoint<K> start;
  ImagePoints<K> start_generators;
  ImagePoint<K> motion;  // in the whole time
  ImagePoints<K> motion_generators;

  ProjectionImage(const ForwardProjection& projection, const PrimitiveContact& contact) {
    const ContactRows<K> rows(contact);
    start = rows.offset + rows.Image(projection.start.center);
    start_generators = rows.Images(projection.start.generators);
    motion = projection.time * rows.Image(projection.velocity.center);
    motion_generators = projection.time * rows.Images(projection.velocity.generators);
  }

  // To be filled in: without errors of the start, without a motion.
  ProjectionImage(Eigen::Index rows, Eigen::Index start_errors, Eigen::Index motion_errors) {
    start.setZero(rows);
    motion.setZero(rows);
    start_generators.setZero(rows, start_errors);
    motion_generators.setZero(rows, motion_errors);
  }

  bool moves() const { return !motion.isZero(0) || !motion_generators.isZero(0); }

  // Leaves out the errors that move nothing here: those of other faces.
  void ForgetZeros() {
    ForgetZeros(start_generators);
    ForgetZeros(motion_generators);
  }

  // A point of it: along the mean motion as near to gap 0 as it comes.
  ImagePoint<K> Begin() const {
    if (motion[0] == 0) return start;
    return start + std::clamp(-start[0] / motion[0], 0.0, 1.0) * motion;
  }

  // The point where a . y is least.
  ImagePoint<K> Lowest(const ImagePoint<K>& a) const {
    ImagePoint<K> lowest = start;
    AddLowest(a, start_generators, lowest);
    ImagePoint<K> farthest = motion;
    AddLowest(a, motion_generators, farthest);
    if (a.dot(farthest) < 0) lowest += farthest;
    return lowest;
  }

 private:
  static void ForgetZeros(ImagePoints<K>& generators) {
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < generators.cols(); ++i) {
      if (!generators.col(i).isZero(0)) generators.col(count++) = generators.col(i);
    }
    generators.conservativeResize(Eigen::NoChange, count);
  }

  static void AddLowest(const ImagePoint<K>& a, const ImagePoints<K>& generators,
                        ImagePoint<K>& sum) {
    for (Eigen::Index i = 0; i < generators.cols(); ++i) {
      const auto g = generators.col(i);
      sum -= std::copysign(1.0, a.dot(g)) * g;
    }
  }
};

// The exact test and the paper's (meeting.h), for up to kUsualRows rows and for any number.
template <int K>
bool Meets(const ProjectionImage<K>& image, double tolerance);
template <int K>
bool EdgeMeets(const ProjectionImage<K>& image);

inline void CheckDimensions(const ForwardProjection& projection, const PrimitiveContact& contact) {
  const Eigen::Index n = contact.row.size();
  ASSAY_CHECK(projection.start.center.size() == n && projection.start.generators.rows() == n &&
              projection.velocity.center.size() == n && projection.velocity.generators.rows() == n);
  for (const HalfSpace& limit : contact.limits) ASSAY_CHECK(limit.a.size() == n);
}

// Calls `use` with the number of rows as the compiler knows it; Eigen::Dynamic: it does not.
template <int K = 1, class Use>
auto WithRows(Eigen::Index rows, const Use& use) {
  if constexpr (K > kUsualRows) {
    return use.template operator()<Eigen::Dynamic>();
  } else {
    return rows == K ? use.template operator()<K>() : WithRows<K + 1>(rows, use);
  }
}

// Calls `use` with the image, whose dimension the compiler knows for the usual contacts.
template <class Use>
auto WithImage(const ForwardProjection& projection, const PrimitiveContact& contact,
               const Use& use) {
  return WithRows(1 + std::ssize(contact.limits),
                  [&]<int K>() { return use(ProjectionImage<K>(projection, contact)); });
}

}  // namespace assay::finemotion
