#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/domain/problem.h"
#include "planner/plan/strategy.h"
#include "sim/scene/scene.h"

namespace assay::cli {

// Pictures of the contact states that a strategy leads through if there are no errors, one for the
// end of each motion: the fixed part as it lies, the held one as lines so that what is behind stays
// in sight, and a cross where the parts touch. Files "03-contacts.png" and so on, and
// contact-sheet.png with all of them, are written to the folder; their names are returned. Throws
// EnvironmentError if there is no renderer.
std::vector<std::string> WriteContactPictures(const std::filesystem::path& folder,
                                              const domain::Problem& problem,
                                              const scene::Scene& scene,
                                              const domain::Mating& mating,
                                              const plan::Strategy& strategy);

}  // namespace assay::cli
