#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/mesh_import/parts/imported_part.h"

namespace assay::mesh_import {

// A shaft of one part in a hole of another one, as the files of both parts have them in one frame.
struct MatedFeatures {
  int shaft = 0;  // number of the feature in its part file
  int hole = 0;
  // Outward direction of the hole's mouth through which the shaft comes, in the frame of the files.
  Vector3 mouth = Vector3::UnitZ();
  double depth = 0;  // of the tip below the mouth, metres
  // The gaps between the shaft and the sides of the hole, in the order of the hole's sides, metres.
  // For a round hole: the least and the greatest gap.
  std::vector<double> gaps;

  double LeastGap() const;
};

struct MatedPair {
  const ImportedPart* held = nullptr;   // the part with the shaft
  const ImportedPart* fixed = nullptr;  // the part with the hole
  // What one motion brings about, the tightest first: layers of the held part in layers of the
  // hole. It has no features that follow from others, for example of a shaft behind an equally wide
  // one.
  std::vector<MatedFeatures> features;
  // How far the held part reaches below the outermost mouth, metres. What stands on the tip of a
  // shaft counts.
  double reach = 0;
  // How far the held part is moved on from where its file has it, to where something stops it,
  // metres.
  double way_to_seat = 0;

  // The pose of the held part in the fixed part, as the files have them, in the frames of the part
  // files.
  geometry::Pose X_FixedHeld() const;
  // The direction of the mating motion in the fixed part, for its first features.
  Vector3 MatingDirection() const;
};

// Finds which features of two parts in their assembled pose mate. A shaft may be larger than its
// hole by 0.01 mm, which counts as rounding. Returns none if no shaft is in a hole.
std::optional<MatedPair> FindMating(const ImportedPart& a, const ImportedPart& b);

// Returns how many sides the polygons that stand for circles need: at least as many as the parts
// have now, and so many that they narrow no gap of a round shaft by more than a quarter, as far as
// 128 sides suffice.
int SidesFor(const MatedPair& pair);

// Tells people what mates, in full sentences.
std::vector<std::string> AccountOf(const MatedPair& pair);

}  // namespace assay::mesh_import
