#pragma once

#include <filesystem>

#include "planner/base/document/document.h"
#include "sim/enact/walk/interpretation.h"
#include "sim/scenario/scenario.h"

namespace assay::enact {

// A scenario with its key `knowledge`.
struct KnowledgeScenario {
  scenario::Scenario scenario;
  Interpretation interpretation;
};

// Reads a scenario file that has a key `knowledge` (scenarios/README.md), with the domain and the
// problem that it names, paths from the file's folder. Throws InputError, also for an action of the
// domain without a skill, a predicate without a meaning, and arguments that name no part where a
// skill or a meaning needs one.
KnowledgeScenario Read(const Document& document, const domain::ModelPath& models);
KnowledgeScenario Load(const std::filesystem::path& file, const domain::ModelPath& models);

}  // namespace assay::enact
