#pragma once

namespace assay::finemotion {

// The range about a pose in which contacts are searched for.
struct ContactRange {
  double reach = 0;  // metres between features
  double turn = 0;   // radians by which the part may be turned
};

}  // namespace assay::finemotion
