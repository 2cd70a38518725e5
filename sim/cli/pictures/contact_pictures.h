#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/strategy.h"
#include "sim/scene/scene.h"

namespace assay::cli {

struct ContactPicture {
  std::string file;  // in the folder
  std::string caption;
};

// Pictures of the contact states that a strategy leads through if there are no errors, one for the
// end of each motion: the fixed part as it lies, the held one as lines so that what is behind stays
// in sight, and a cross where the parts touch. Files "03-contacts.png" and so on are written to the
// folder, and one of all of them, which is the last of those returned. Throws EnvironmentError if
// there is no renderer.
std::vector<ContactPicture> WriteContactPictures(const std::filesystem::path& folder,
                                                 const domain::Problem& problem,
                                                 const scene::Scene& scene,
                                                 const domain::Mating& mating,
                                                 const plan::Strategy& strategy);

}  // namespace assay::cli
