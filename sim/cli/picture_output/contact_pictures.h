#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/strategy.h"
#include "sim/scene/scene.h"

namespace assay::cli {

// A picture file with its caption.
struct ContactPicture {
  std::string file;  // file name in the folder
  std::string caption;
};

// Writes pictures of the contact states that a strategy leads through without errors, one for the
// end of each motion. A picture shows the fixed part as it lies, and a cross where the parts touch.
// The held part is drawn as lines, so that the things behind it are visible. The files in `folder`
// are called "03-contacts.png" and so on. Returns these files, followed by one file that shows all
// pictures. Throws EnvironmentError if there is no renderer.
std::vector<ContactPicture> WriteContactPictures(const std::filesystem::path& folder,
                                                 const domain::Problem& problem,
                                                 const scene::Scene& scene,
                                                 const domain::Mating& mating,
                                                 const plan::Strategy& strategy);

}  // namespace assay::cli
