#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "sim/noise/sampling.h"
#include "sim/scene/mjcf.h"

namespace assay::sweep {

// What a sensor of the plan does in a trial.
enum class Sensing {
  kDrawn,   // it errs within its promise, as drawn from the error box
  kCamera,  // pictures are rendered, and the parts found in them
};

// How the trials of a cell come by their errors.
enum class NoiseKind {
  kNone,  // as noise::Mode says
  kUniform,
  kVertices,
  kLowDiscrepancy,
  kAttack,  // the whole cell is one trial: an attack (check/attack.h)
};
noise::Mode ModeOf(NoiseKind kind);  // checked that it is no attack

// In the order of their enumerations.
const std::vector<std::string>& NoiseNames();
const std::vector<std::string>& SensingNames();
const std::vector<std::string>& PropagationNames();
const std::vector<std::string>& GraspNames();
std::string_view Name(NoiseKind kind);
std::string_view Name(Sensing sensing);
std::string_view Name(uncertainty::Propagation propagation);

using Resolvers = std::vector<domain::ResolverKind>;  // ascending
std::string Name(const Resolvers& resolvers);         // "sensing,fine-motion"

// A sweep file ("assay-sweep/1"): a grid of trials. Each list is an axis; no value is in it twice.
struct Sweep {
  std::filesystem::path file;  // as the user gave it
  std::string text;            // the whole file

  std::string title = {};
  std::vector<std::string> scenarios = {};  // paths from the file's folder, as they stand there
  std::vector<std::optional<double>> clearances = {std::nullopt};  // metres; none: the scenario's
  std::vector<double> error_scales = {1};  // factors on the errors of parts and hand
  std::vector<uncertainty::Propagation> propagations = {uncertainty::Propagation::kSound};
  std::vector<std::optional<Resolvers>> resolvers = {std::nullopt};  // none: the scenario's
  std::vector<scene::GraspMode> grasps = {scene::GraspMode::kFriction};
  std::vector<Sensing> sensings = {Sensing::kDrawn};
  std::vector<NoiseKind> noises = {NoiseKind::kUniform};
  std::vector<std::uint64_t> seeds = {0};
  int trials = 0;             // of each cell; 0 if there are attacks only
  int control_trials = 1;     // of each cell without noise
  int attempts = 1000;        // of each attack
  bool conservatism = false;  // each attack also measures how much more noise it takes
  // Of the planner: budgets, for all cells.
  std::int64_t partial_plans = constraint_posting::PlannerOptions().partial_plans;
  std::int64_t instances = constraint_posting::UncertaintyOptions().instances;

  std::filesystem::path PathOf(const std::string& scenario) const;
};

// All throw InputError.
Sweep Load(const std::filesystem::path& file);
// `text`: of the document.
Sweep ReadSweep(const Document& document, const std::filesystem::path& file, std::string text);

}  // namespace assay::sweep
