#pragma once

#include <limits>
#include <span>

#include "sim/sense/displacement.h"
#include "sim/sense/fitting/edge_search.h"

namespace assay::sense {

// The fit of a silhouette to pictures.
struct PoseFit {
  Displacement displacement = Displacement::Zero();  // from the believed pose
  int edges = 0;        // contour points whose edge was found within a pixel of the fit
  double found = 0;     // `edges` as a fraction of all contour points
  double residual = 0;  // root mean square of the distances of these edges, pixels
  // Standard deviations of the displacement under the assumption that the errors of the edges are
  // independent and as large as the residual (at least a tenth of a pixel). The deviation of a
  // coordinate is infinite if the edges do not determine this coordinate. In truth the errors are
  // not independent: neighbouring edges have the same error. True errors of ten standard deviations
  // therefore occur.
  Displacement deviation = Displacement::Constant(std::numeric_limits<double>::infinity());
};

// Returns the displacement of the part at which the contour of its silhouette is nearest to the
// edges in all pictures together. The search starts at the displacement `start`. It is Gauss-Newton
// over x, y, z and yaw, with a search range for edges that begins wide and ends narrow. Tukey's
// weights leave out edges that do not belong to the part. Edges just above the table are not used,
// because it is unknown how far the table's surface hides the part.
PoseFit FitPose(std::span<const Picture> pictures, const domain::PartModel& model,
                const Pose& believed, const Displacement& start);

}  // namespace assay::sense
