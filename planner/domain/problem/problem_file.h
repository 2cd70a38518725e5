#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/units/units.h"
#include "planner/domain/workcell/model_path.h"

namespace assay::domain {

// Reads the problem in a scenario file ("assay-scenario/1"): title, description, units, workcell,
// rules (those of the workcell that this scenario replaces), clearance, tolerances, parts, gripper,
// sensing, resolvers, mating_errors, `initially` (matings that hold at the start, written like
// goals), and goal.
//
// `models` is searched for parts and the workcell. The key `simulation` is left to sim/scenario.
// Throws InputError with the place of the error. scenarios/README.md describes the format.
Problem ReadProblem(const Document& scenario, const ModelPath& models);

// The changes that options or a sweep make to a scenario without writing a new file.
struct Overrides {
  std::optional<double> clearance = std::nullopt;  // metres, in place of the file's
  // Factor, 0 or more, of every error of parts and gripper. The promises of sensors and the
  // tolerances are not scaled.
  double error_scale = 1;
  std::optional<std::vector<ResolverKind>> resolvers = std::nullopt;
  // Index of the chosen pose, by the name of a part with an open pose.
  std::map<std::string, int> poses = {};
};
// Reads the problem with these changes. Each open pose is the first one unless the overrides choose
// another.
Problem ReadProblem(const Document& scenario, const ModelPath& models, const Overrides& overrides);

// Returns the worlds that the scenario allows: a problem for each choice of the open poses, in the
// order of the file. The choice of the last part changes fastest. There is one world if no pose is
// open.
inline constexpr int kMostWorlds = 64;
std::vector<Problem> ReadWorlds(const Document& scenario, const ModelPath& models,
                                const Overrides& overrides);

}  // namespace assay::domain
