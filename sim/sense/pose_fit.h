#pragma once

#include <limits>
#include <span>

#include "sim/sense/displacement.h"
#include "sim/sense/edge_search.h"

namespace assay::sense {

// How a silhouette fits pictures.
struct PoseFit {
  Displacement displacement = Displacement::Zero();  // from the believed pose
  int edges = 0;        // contour points whose edge was found where the fit has it
  double found = 0;     // that, as a fraction of all contour points
  double residual = 0;  // root of the mean square of their distances, pixels
  // Standard deviations of the displacement, if each edge's place is wrong by itself by the
  // residual (at least a tenth of a pixel); infinite if the edges do not tell. Edges that are near
  // each other are wrong alike, so that true errors of ten deviations occur.
  Displacement deviation = Displacement::Constant(std::numeric_limits<double>::infinity());
};

// The displacement of the part, seen from `start`, at which the contour of its silhouette is
// nearest to the edges in all pictures together: Gauss-Newton over x, y, z and yaw with Tukey's
// weights, that leave out edges that are not the part's, and a search for edges that begins wide
// and ends narrow. Edges next to the table are not used: how deep the part stands behind the
// table's surface is not known.
PoseFit FitPose(std::span<const Picture> pictures, const domain::PartModel& model,
                const Pose& believed, const Displacement& start);

}  // namespace assay::sense
