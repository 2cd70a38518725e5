#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "planner/finemotion/contact_graph/c_surfaces.h"
#include "planner/finemotion/contact_graph/contact_facet.h"

namespace assay::finemotion {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

// The end of a ray, in metres from its start.
struct RayEnd {
  double length = kNever;
  bool hit = false;  // true if a contact is made
};

// Casts rays among C-surfaces from one pose after another. Most of the time that a contact graph
// takes is spent here, so the class stands in a header, and its loops allocate nothing.
class ContactRays {
 public:
  explicit ContactRays(const CSurfaces& surfaces) : surfaces_(surfaces) {}

  // Sets the pose from which rays are cast.
  void StartAt(const ScaledPose& x) {
    surfaces_.GapsAt(x, gaps_);
    surfaces_.ExcessesAt(x, excesses_);
  }
  // Returns the gap of a surface at the start.
  double Gap(int surface) const { return gaps_[surface]; }

  // Casts a ray along g from the start, which must be a point of the facet.
  // Returns where a ray makes its first contact, leaves what the facet touches, or gets behind a
  // surface past the surface's limits. The third case occurs because linear patches do not quite
  // match where one contact takes over from another.
  RayEnd Cast(const ContactFacet& facet, const ScaledPose& g) {
    surfaces_.RatesAlong(g, rates_);
    RayEnd end;
    for (const int k : facet.surfaces) end.length = std::min(end.length, EndOnSurface(k, g));
    end.length += kTouch;  // at this distance a face may come to lie flat
    std::size_t member = 0;
    for (int k = 0; k < surfaces_.size(); ++k) {
      if (member < facet.surfaces.size() && facet.surfaces[member] == k) {
        ++member;
      } else {
        Meet(k, g, end);
      }
    }
    return end;
  }

 private:
  // Returns where the ray leaves the surface. The ray may pass through several of the surface's
  // patches, if each begins where the one before it ends.
  double EndOnSurface(int surface, const ScaledPose& g) const {
    const std::vector<CSurfaces::Patch>& patches = surfaces_.Patches(surface);
    double end = 0;
    for (std::size_t i = 0; i < patches.size();) {
      const Stretch stretch = surfaces_.StretchOf(patches[i], excesses_, g);
      const bool goes_on = stretch.from <= end + kTouch && stretch.to > end + kTouch;
      if (goes_on) end = stretch.to;
      i = goes_on && patches.size() > 1 && end < kNever ? 0 : i + 1;
    }
    return end;
  }

  // Moves the ray's end forward to where the ray meets the surface or gets behind it, if that comes
  // first. A contact is also made from behind the surface if the ray reaches the surface's limits
  // just as the gap reaches 0. An example is the other half of an edge that comes to lie flat.
  void Meet(int surface, const ScaledPose& g, RayEnd& end) const {
    const double gap = gaps_[surface];
    const double rate = rates_[surface];
    // The gap is not positive between `from` and `to`.
    double from = 0;
    double to = kNever;
    if (gap > kTouch) {
      if (rate >= -kAlong) return;
      from = -gap / rate;
    } else if (rate > kAlong) {
      to = std::max(0.0, -gap / rate);
    }
    if (from >= end.length) return;
    for (const CSurfaces::Patch& patch : surfaces_.Patches(surface)) {
      const Stretch stretch = surfaces_.StretchOf(patch, excesses_, g);
      const double entry = std::max(from, stretch.from);
      const double exit = std::min(to, stretch.to);
      if (entry >= end.length || entry > exit + kTouch) continue;
      const bool touches = gap + entry * rate > -kTouch;
      const bool gets_behind = stretch.inside && entry + kTouch < exit;
      if (!touches && !gets_behind) continue;
      end = {entry, touches};
    }
  }

  const CSurfaces& surfaces_;
  Eigen::VectorXd gaps_;
  std::vector<double> excesses_;
  Eigen::VectorXd rates_;  // rates of change of the gaps along the ray
};

}  // namespace assay::finemotion
