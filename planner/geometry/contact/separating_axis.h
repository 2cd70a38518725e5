#pragma once

#include <limits>

#include "planner/geometry/contact/contact_solid.h"
#include "planner/geometry/coordinates.h"

namespace assay::geometry {

// The axes along which two convex solids can be least deep in each other: the normals of their
// facets, and the common normals of an edge of each (Gottschalk, Lin and Manocha 1996). The
// separation along an axis is the width of the gap between the solids, metres. It is negative if
// they overlap along the axis.

// The facet along whose normal the other solid is farthest away.
struct FacetAxis {
  double separation = -std::numeric_limits<double>::infinity();
  int facet = 0;
};
// Returns the best axis among the facets of `of`. The search ends at a facet that separates the
// solids by more than `enough`.
FacetAxis BestFacet(const ContactSolid& of, const ContactSolid& other, const Pose& X_OfOther,
                    double enough);

// The pair of edges along whose common normal the solids are farthest apart.
struct EdgeAxis {
  double separation = -std::numeric_limits<double>::infinity();
  Vector3 normal = Vector3::Zero();  // unit, from a to b, in the frame of a
  int edge_of_a = 0;
  int edge_of_b = 0;
};
// Returns the best axis among the pairs of edges that can touch. Two edges can touch if their
// ranges of normals (arcs of the Gauss maps) cross. Nearly parallel edges are left out, because the
// normal of a facet is as good.
EdgeAxis BestEdges(const ContactSolid& a, const ContactSolid& b, const Pose& X_AB);

}  // namespace assay::geometry
