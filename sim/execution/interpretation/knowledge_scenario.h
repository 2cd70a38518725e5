#pragma once

#include <filesystem>

#include "planner/base/input_files/document.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "sim/execution/interpretation/interpretation.h"
#include "sim/scenario/scenario.h"

namespace assay::execution {

// A scenario and the interpretation that its key `knowledge` gives.
struct KnowledgeScenario {
  scenario::Scenario scenario;
  Interpretation interpretation;
};

// How the plans for the worlds of a scenario are made, and which changes are made to the scenario.
struct WorldPlanning {
  domain::Overrides overrides = {};
  constraint_posting::PlannerOptions planner = {};
  constraint_posting::UncertaintyOptions uncertainty = {};
};

// Reads a scenario file that has a key `knowledge` (scenarios/README.md), with the domain and the
// problem that it names by paths from the file's folder. Without that key, the scenario's open
// poses and the verifications of its plans make the contingent problem. Throws InputError for wrong
// files, for an action of the domain without a skill, for a predicate without a meaning, and for
// arguments that name no part where a skill or a meaning needs one.
KnowledgeScenario Read(const Document& document, const domain::ModelPath& models,
                       const WorldPlanning& planning = {});
KnowledgeScenario Load(const std::filesystem::path& file, const domain::ModelPath& models);

// Returns whether a scenario needs an interpretation, because its plan is a tree: its goal is one
// of knowledge, or the pose of a part is open until a sensor has looked.
bool NeedsATree(const Document& scenario);

}  // namespace assay::execution
