#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/sampling.h"
#include "sim/scene/mjcf.h"

namespace assay::sweep {

using check::Sensing;

// The source of the errors in the trials of a cell.
enum class NoiseKind {
  kNone,  // see noise::Mode for the first four
  kUniform,
  kVertices,
  kLowDiscrepancy,
  kFalsification,  // the whole cell is one trial, a falsification of the plan
};
noise::Mode ModeOf(NoiseKind kind);

const std::vector<std::string>& GraspNames();
std::string_view Name(NoiseKind kind);
std::string_view Name(Sensing sensing);
std::string_view Name(uncertainty::Propagation propagation);

using Resolvers = std::vector<domain::ResolverKind>;  // ascending
std::string Name(const Resolvers& resolvers);         // like "sensing,fine-motion"

// The contents of a sweep file ("assay-sweep/1"), a grid of trials. Each list is an axis of the
// grid and has no value twice.
struct Sweep {
  std::filesystem::path file;  // the path as the user gave it
  std::string text;            // the text of the whole file

  std::string title = {};
  // Paths relative to the sweep file's folder, as written in the sweep file.
  std::vector<std::string> scenarios = {};
  std::vector<std::optional<double>> clearances = {std::nullopt};
  std::vector<double> error_scales = {1};  // factors on the errors of parts and hand
  std::vector<uncertainty::Propagation> propagations = {uncertainty::Propagation::kSound};
  std::vector<std::optional<Resolvers>> resolvers = {std::nullopt};  // none: those of the scenario
  std::vector<scene::GraspMode> grasps = {scene::GraspMode::kFriction};
  std::vector<Sensing> sensings = {Sensing::kDrawn};
  std::vector<NoiseKind> noises = {NoiseKind::kUniform};
  std::vector<std::uint64_t> seeds = {0};
  int trials = 0;             // trials of each cell; 0 if all cells are falsifications
  int control_trials = 1;     // trials of each cell without noise
  int attempts = 1000;        // attempts of each falsification
  bool conservatism = false;  // falsifications measure the noise that breaks the plan, too
  // Budgets of the planner, for all cells.
  std::int64_t partial_plans = constraint_posting::PlannerOptions().partial_plans;
  std::int64_t instances = constraint_posting::UncertaintyOptions().instances;

  std::filesystem::path PathOf(const std::string& scenario) const;
};

// Read a sweep file. Throw InputError.
Sweep Load(const std::filesystem::path& file);
// `text` is the text of the document.
Sweep ReadSweep(const Document& document, const std::filesystem::path& file, std::string text);

}  // namespace assay::sweep
