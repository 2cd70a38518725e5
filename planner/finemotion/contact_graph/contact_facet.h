#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/finemotion/contact_graph/c_surfaces.h"
#include "planner/finemotion/contact_graph/surface_set.h"

namespace assay::finemotion {

// A row depends on other rows if its component across their span is shorter than this.
inline constexpr double kDependentRow = 1e-7;

// The poses at which the gaps of a set of surfaces are all 0, whether the surfaces' limits hold
// there or not.
struct ContactFacet {
  using Tangents = Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>;

  SurfaceSet set;
  std::vector<int> surfaces;     // the surfaces of the set, ascending
  std::vector<int> independent;  // independent ones among the surfaces, as many as the rank
  // Column i closes a gap of 1 of the independent surface i and leaves the gaps of the others.
  Tangents corrections;
  Tangents tangents;               // orthonormal columns
  std::vector<ScaledPose> points;  // poses on the facet, target points first
  std::size_t explored = 0;        // number of points whose neighbours have been searched for

  int dimension() const { return static_cast<int>(tangents.cols()); }
};

// Returns the facet of a set of surfaces, without points.
ContactFacet FacetOf(const CSurfaces& surfaces, const SurfaceSet& set);

// Returns x, moved so that the facet's gaps become 0. Rounding has left these gaps.
ScaledPose Onto(const CSurfaces& surfaces, const ContactFacet& facet, const ScaledPose& x);

}  // namespace assay::finemotion
