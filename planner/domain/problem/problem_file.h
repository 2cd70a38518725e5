#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/problem/units.h"
#include "planner/domain/workcell/model_path.h"

namespace assay::domain {

// Reads the problem in a scenario file ("assay-scenario/1"): title, description, units, workcell,
// rules (those of the workcell that this scenario replaces), clearance, tolerances, parts, gripper,
// sensing, resolvers, mating_errors, `initially` (matings that hold at the start, written like
// goals), and goal.
// `models`: where parts and the workcell are looked for. The key `simulation` is left to
// sim/scenario. Throws InputError for what is wrong, with the place. scenarios/README.md describes
// the format.
Problem ReadProblem(const Document& scenario, const ModelPath& models);

// What a study changes of a scenario without writing it anew.
struct Overrides {
  std::optional<double> clearance = std::nullopt;  // metres, as if the file said so
  // Of every error of parts and gripper, 0 or more; not of what sensors promise, nor of tolerances.
  double error_scale = 1;
  std::optional<std::vector<ResolverKind>> resolvers = std::nullopt;
  std::map<std::string, int> poses = {};  // of parts whose pose is open: which, by the part's name
};
// Of an open pose, the first unless the overrides say which.
Problem ReadProblem(const Document& scenario, const ModelPath& models, const Overrides& overrides);

// The worlds that the scenario allows: a problem for each choice of the open poses, in the order of
// the file, those of the last part changing fastest. One if none is open.
inline constexpr int kMostWorlds = 64;
std::vector<Problem> ReadWorlds(const Document& scenario, const ModelPath& models,
                                const Overrides& overrides);

}  // namespace assay::domain
