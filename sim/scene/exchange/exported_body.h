#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::scene {

// A part in a file for other programs. It consists of convex pieces, so its holes stay open there.
struct ExportedBody {
  std::string name;
  std::shared_ptr<const domain::PartModel> model;
  geometry::Pose X_WorldPart = geometry::Pose::Identity();
  bool is_fixed = false;  // it stands still; every other part moves freely
};

// Returns the two parts of a mating in their mated pose. The fixed part comes first. It stands
// still, and its frame is that of the world.
std::vector<ExportedBody> ExportedPair(const domain::Problem& problem,
                                       const domain::Mating& mating);

// A file beside others, without its folder.
struct ExportedFile {
  std::string name;
  std::string text;
};

// Returns a model for MuJoCo. Its contacts are as stiff as its timestep allows, so that a shaft
// sinks into the walls of its hole by as little as possible. The model has gravity and no floor.
// Lengths are in metres, masses in kilograms.
std::string BodiesToMjcf(const std::string& name, const std::vector<ExportedBody>& bodies);

// Returns a robot description NAME.urdf, and after it the OBJ files of the pieces that are no
// boxes, to which the description refers. Part frames are link frames. The first part is the root,
// and the others are joined to it by floating joints. The friction of parts has no place in URDF.
std::vector<ExportedFile> BodiesToUrdf(const std::string& name,
                                       const std::vector<ExportedBody>& bodies);

// Returns an OBJ file in metres with an object PART-N for each convex piece, all in the frame of
// the world.
std::string BodiesToObj(const std::vector<ExportedBody>& bodies);

}  // namespace assay::scene
