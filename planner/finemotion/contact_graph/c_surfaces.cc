#include "planner/finemotion/contact_graph/c_surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "planner/geometry/polygon.h"
#include "planner/numeric/nonnegative_least_squares.h"

namespace assay::finemotion {

namespace {

constexpr double kWellInside = 1e-6;  // metres from a limit, well above all rounding

bool IsTurn(const HalfSpace& limit) { return limit.a.head<3>().isZero(0); }

ScaledPose ToScaledPose(const Eigen::VectorXd& a, double radius) {
  ScaledPose scaled = a.head<kPoseDimensions>();
  scaled.tail<3>() /= radius;
  return scaled;
}

bool OnOneSurface(const PrimitiveContact& a, const PrimitiveContact& b) {
  return std::abs(a.offset - b.offset) < kSameSurface &&
         (a.row - b.row).cwiseAbs().maxCoeff() < kSameSurface;
}

}  // namespace

CSurfaces::CSurfaces(const std::vector<PrimitiveContact>& contacts, double radius) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto first = std::ranges::find_if(first_contacts_, [&](int other) {
      return OnOneSurface(contacts[static_cast<std::size_t>(other)], contacts[i]);
    });
    const auto surface = static_cast<std::size_t>(first - first_contacts_.begin());
    if (first == first_contacts_.end()) {
      first_contacts_.push_back(static_cast<int>(i));
      patches_.emplace_back();
    }
    patches_[surface].push_back(AddLimits(contacts[i].limits, radius));
  }
  rows_.resize(size(), kPoseDimensions);
  offsets_.resize(size());
  for (int k = 0; k < size(); ++k) {
    const PrimitiveContact& contact = contacts[static_cast<std::size_t>(FirstContact(k))];
    rows_.row(k) = ToScaledPose(contact.row, radius);
    offsets_[k] = contact.offset;
  }
  for (int k = 0; k < size(); ++k) {
    for (const Patch& patch : Patches(k)) CloseEnds(k, patch);
  }
}

void CSurfaces::CloseEnds(int surface, const Patch& patch) {
  for (auto i = static_cast<std::size_t>(patch.begin); std::cmp_less(i, patch.end); ++i)
    limits_[i].open = limits_[i].open && !StopsAtOthers(limits_[i], surface);
}

// Adds a patch's limits. The limits of rotations are in radians; multiplied by the radius, they are
// lengths like the others.
CSurfaces::Patch CSurfaces::AddLimits(const std::vector<HalfSpace>& limits, double radius) {
  const int begin = static_cast<int>(limits_.size());
  for (const HalfSpace& limit : limits) {
    const bool turn = IsTurn(limit);
    const double size = turn ? radius : 1 / limit.a.head<3>().norm();
    limits_.push_back({size * ToScaledPose(limit.a, radius), size * limit.b, !turn});
  }
  return {begin, static_cast<int>(limits_.size())};
}

// Returns whether every point of the surface that exceeds the limit is behind other surfaces. By
// Farkas' lemma this holds if, on the surface, the excess is minus a sum of nonnegative multiples
// of other gaps. One gap suffices if a wall rises at the limit. Several gaps are needed if a face
// lands on other features beside the one that the limit belongs to.
bool CSurfaces::StopsAtOthers(const Limit& limit, int surface) const {
  using Gap = Eigen::Vector<double, kPoseDimensions + 1>;
  const Gap own = (Gap() << Row(surface), offsets_[surface]).finished().normalized();
  const auto there = [&](const Gap& gap) -> Gap { return gap - gap.dot(own) * own; };
  const Vector3 across = limit.a.head<3>().cross(own.head<3>());
  Eigen::MatrixXd gaps(own.size(), size());
  Eigen::Index count = 0;
  for (int k = 0; k < size(); ++k) {
    if (k == surface || std::abs(across.dot(Row(k).head<3>())) > kSameSurface) continue;
    gaps.col(count++) = there((Gap() << Row(k), offsets_[k]).finished());
  }
  gaps.conservativeResize(Eigen::NoChange, count);
  const Gap excess = there((Gap() << limit.a, -limit.b).finished());
  const Eigen::VectorXd multiples = numeric::NonnegativeLeastSquares(gaps, -excess);
  return count > 0 && (gaps * multiples + excess).cwiseAbs().maxCoeff() < kSameSurface;
}

bool CSurfaces::AreOneSeam(std::size_t limit, std::size_t other) const {
  return std::abs(limits_[limit].b + limits_[other].b) < kSameSurface &&
         (limits_[limit].a + limits_[other].a).cwiseAbs().maxCoeff() < kSameSurface;
}

std::vector<HalfSpace> CSurfaces::Limits(const Patch& patch) const {
  std::vector<HalfSpace> limits;
  for (int i = patch.begin; i < patch.end; ++i) {
    const Limit& limit = limits_[static_cast<std::size_t>(i)];
    limits.push_back({limit.a, limit.b});
  }
  return limits;
}

void CSurfaces::GapsAt(const ScaledPose& x, Eigen::VectorXd& gaps) const {
  gaps = offsets_;
  gaps.noalias() += rows_ * x;
}

void CSurfaces::RatesAlong(const ScaledPose& g, Eigen::VectorXd& rates) const {
  rates.noalias() = rows_ * g;
}

void CSurfaces::ExcessesAt(const ScaledPose& x, std::vector<double>& excesses) const {
  excesses.resize(limits_.size());
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    excesses[i] = limits_[i].a.dot(x) - limits_[i].b;
  }
}

bool CSurfaces::Covers(int surface, const ScaledPose& x) const {
  std::array<std::size_t, 4> ends;  // ends of patches that contain x at one of their ends
  std::size_t count = 0;
  for (const Patch& patch : Patches(surface)) {
    bool outside = false;
    int ends_here = 0;
    std::size_t end = 0;
    for (auto i = static_cast<std::size_t>(patch.begin); std::cmp_less(i, patch.end); ++i) {
      const double excess = limits_[i].a.dot(x) - limits_[i].b;
      outside = outside || excess > kTouch;
      if (outside) break;
      if (excess < -kTouch || !limits_[i].open) continue;
      ++ends_here;
      end = i;
    }
    if (outside || ends_here > 1) continue;
    if (ends_here == 0) return true;
    for (std::size_t i = 0; i < count; ++i) {
      if (AreOneSeam(ends[i], end)) return true;
    }
    if (count < ends.size()) ends[count++] = end;
  }
  return false;
}

bool CSurfaces::IsInside(
    int surface, const ScaledPose& x,
    const Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>& tangents) const {
  return std::ranges::any_of(Patches(surface), [&](const Patch& patch) {
    const std::span limits(limits_.begin() + patch.begin, limits_.begin() + patch.end);
    return std::ranges::all_of(limits, [&](const Limit& limit) {
      const double excess = limit.a.dot(x) - limit.b;
      if (excess > kTouch || excess < -kWellInside) return excess < 0;
      return (tangents.transpose() * limit.a).isZero(kSameSurface);
    });
  });
}

Stretch CSurfaces::StretchOf(const Patch& patch, const std::vector<double>& excesses,
                             const ScaledPose& g) const {
  constexpr Stretch kNowhere = {1, 0, false};
  Stretch stretch;
  for (auto i = static_cast<std::size_t>(patch.begin); std::cmp_less(i, patch.end); ++i) {
    const double excess = excesses[i];
    const double rate = limits_[i].a.dot(g);
    if (rate > -kAlong && excess > kTouch) return kNowhere;
    if (rate > kAlong) {
      stretch.to = std::min(stretch.to, std::max(0.0, -excess / rate));
    } else if (rate < -kAlong) {
      stretch.from = std::max(stretch.from, -excess / rate);
    } else if (excess > -kTouch && limits_[i].open) {
      stretch.inside = false;
    }
  }
  return stretch;
}

}  // namespace assay::finemotion
