#pragma once

#include <string>

#include "planner/domain/problem_file.h"

namespace assay::posting {

inline domain::Problem LoadScenario(const std::string& name) {
  const std::string root = ASSAY_SOURCE_DIR;
  return domain::ReadProblem(Document::Load(root + "/scenarios/" + name + ".yaml"),
                             root + "/models");
}

// A scenario from its text, with the models of the project.
inline domain::Problem ScenarioFrom(const std::string& text) {
  return domain::ReadProblem(Document::Parse(text, "scenario.yaml"),
                             std::string(ASSAY_SOURCE_DIR) + "/models");
}

// Peg and block as in Spar's example, with these poses of the part file.
inline std::string PegAndBlock(const std::string& block_pose, const std::string& peg_pose,
                               const std::string& more = "") {
  return R"(format: assay-scenario/1
units: {length: inch, angle: degree}
workcell: puma762-table
parts:
  block: {model: block, pose: )" +
         block_pose + R"(}
  peg: {model: peg, pose: )" +
         peg_pose + R"(}
goal:
  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],
                pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [3, 0, 3.25]]},
                mating_vector: [-4, 0, 0]}
)" + more;
}

}  // namespace assay::posting
