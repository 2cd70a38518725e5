#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/finemotion/contact_graph/contact_chain.h"
#include "sim/cli/mating_output/mating_report.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// The subject of the pictures.
struct PicturedMating {
  const PlannedProblem& planned;
  const domain::Mating& mating;
  const finemotion::MatingGeometry& geometry;
  const finemotion::ContactChain& chain;
  const finemotion::FineMotionPlan& plan;  // must have motions
  const plan::Strategy& strategy;          // the strategy of `plan`
  const std::optional<MatingStudy>& study;
};

// Writes the contact pictures (see contact_pictures.h), the contact graph of each critical point as
// graph-1.svg and so on, and index.html, one page with all of them. Returns the files' names.
std::vector<std::string> WriteMatingPictures(const std::filesystem::path& folder,
                                             const PicturedMating& mating);

}  // namespace assay::cli
