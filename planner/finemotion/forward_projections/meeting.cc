#include "planner/finemotion/forward_projections/meeting.h"

#include <algorithm>
#include <span>
#include <vector>

#include "planner/base/check.h"
#include "planner/finemotion/forward_projections/projection_image.h"
#include "planner/numeric/nearest_point.h"

namespace assay::finemotion {

namespace {

void CheckDimensions(const ForwardProjection& projection, const PrimitiveContact& contact) {
  const Eigen::Index n = contact.row.size();
  ASSAY_CHECK(projection.start.center.size() == n && projection.start.generators.rows() == n &&
              projection.velocity.center.size() == n && projection.velocity.generators.rows() == n);
  for (const HalfSpace& limit : contact.limits) ASSAY_CHECK(limit.a.size() == n);
}

// The rows of a contact, without the coordinates whose coefficients are 0 in every row. There are
// many of them, because most tolerances displace faces that the contact does not involve.
struct ContactRows {
  std::vector<Eigen::Index> coordinates;
  Eigen::MatrixXd columns;  // one column for each of the coordinates

  explicit ContactRows(const PrimitiveContact& contact)
      : columns(1 + std::ssize(contact.limits), contact.row.size()) {
    coordinates.reserve(contact.row.size());
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
      const Eigen::Index column = std::ssize(coordinates);
      columns(0, column) = contact.row[i];
      bool is_read = contact.row[i] != 0;
      for (Eigen::Index j = 1; j < columns.rows(); ++j) {
        columns(j, column) = contact.limits[j - 1].a[i];
        is_read = is_read || columns(j, column) != 0;
      }
      if (is_read) coordinates.push_back(i);
    }
  }

  void AddImage(const double* direction, double* image) const {
    const double* column = columns.data();
    const double* const image_end = image + columns.rows();
    for (const Eigen::Index coordinate : coordinates) {
      const double value = direction[coordinate];
      if (value == 0) {
        column += columns.rows();
      } else {
        for (double* entry = image; entry != image_end; ++entry) *entry += value * *column++;
      }
    }
  }
};

bool IsZero(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return value == 0; });
}

}  // namespace

ProjectionImage::ProjectionImage(const ForwardProjection& projection,
                                 const PrimitiveContact& contact)
    : ProjectionImage(1 + std::ssize(contact.limits), projection.start.generators.cols(),
                      projection.velocity.generators.cols()) {
  CheckDimensions(projection, contact);
  const ContactRows contact_rows(contact);
  contact_rows.AddImage(projection.start.center.data(), &start(0));
  for (Eigen::Index i = 0; i < start_errors_; ++i)
    contact_rows.AddImage(projection.start.generators.col(i).data(), &start_error(0, i));
  start(0) += contact.offset;
  for (Eigen::Index j = 1; j < rows(); ++j) start(j) -= contact.limits[j - 1].b;
  contact_rows.AddImage(projection.velocity.center.data(), &motion(0));
  for (Eigen::Index i = 0; i < motion_errors_; ++i)
    contact_rows.AddImage(projection.velocity.generators.col(i).data(), &motion_error(0, i));
  for (Eigen::Index j = 0; j < rows(); ++j) {
    motion(j) *= projection.time;
    for (Eigen::Index i = 0; i < motion_errors_; ++i) motion_error(j, i) *= projection.time;
  }
}

bool ProjectionImage::moves() const {
  return !IsZero({Column(kMotion), Column(kMotion + 1)}) ||
         !IsZero(
             {Column(kErrors + start_errors_), Column(kErrors + start_errors_ + motion_errors_)});
}

void ProjectionImage::ForgetZeros() {
  Eigen::Index kept = 0;
  Eigen::Index kept_of_start = 0;
  for (Eigen::Index i = 0; i < start_errors_ + motion_errors_; ++i) {
    const std::span error(Column(kErrors + i), Column(kErrors + i + 1));
    if (IsZero(error)) continue;
    std::ranges::copy(error, columns_.data() + (kErrors + kept) * rows());
    ++kept;
    if (i < start_errors_) kept_of_start = kept;
  }
  start_errors_ = kept_of_start;
  motion_errors_ = kept - kept_of_start;
}

Meeting Meet(const ForwardProjection& projection, const PrimitiveContact& contact,
             double tolerance) {
  ProjectionImage image(projection, contact);
  image.ForgetZeros();
  const double margin = WithPoints(image, [&]<int K>(const ImagePoints<K>& points) {
    return numeric::NearestPoint<K, 1, ImagePoints<K>>(points, tolerance).Distance();
  });
  return {.meets = margin == 0, .margin = margin};
}

bool Meets(const ProjectionImage& image, double tolerance) {
  return WithPoints(image, [&]<int K>(const ImagePoints<K>& points) {
    return !numeric::NearestPoint<K, 1, ImagePoints<K>>(points, tolerance).IsApart();
  });
}

}  // namespace assay::finemotion
