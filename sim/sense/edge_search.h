#pragma once

#include <optional>

#include "sim/sense/palette.h"
#include "sim/sense/silhouette.h"

namespace assay::sense {

// What an eye saw.
struct Picture {
  View view;
  render::Image image;
  SurfaceMap surfaces;
};

// How far the part's edge is from a contour point, along its normal, pixels: where the part ends
// and the table begins nearest to it, within `range`. Only the table is sure to be behind the part:
// a border between the part and anything else may be that of what hides it. None if there is no
// such edge or its place is not clear.
std::optional<double> FindEdge(const Picture& picture, const ContourPoint& point, double range);

}  // namespace assay::sense
