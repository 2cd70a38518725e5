#pragma once

#include <optional>

#include "sim/sense/fitting/silhouette.h"
#include "sim/sense/palette.h"

namespace assay::sense {

// A picture that an eye took, with its view and the surface that each pixel shows.
struct Picture {
  View view;
  render::Image image;
  SurfaceMap surfaces;
};

// Returns the distance from a contour point to the part's edge in the picture, along the point's
// normal, in pixels. The edge is the nearest place within `range` where the part ends and the table
// begins. Only the table is sure to be behind the part. A border between the part and anything else
// may belong to something that hides the part. Returns none if there is no edge or its place is
// unclear.
std::optional<double> FindEdge(const Picture& picture, const ContourPoint& point, double range);

}  // namespace assay::sense
