#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "planner/assembly/certified_plan.h"
#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/plan/certificates/not_covered.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/error_box.h"
#include "sim/noise/sampling.h"
#include "tests/scratch_file.h"

// What the tests on random scenes share.
namespace assay::check {

using geometry::Vector3;

// Returns the number in the environment variable `name`, or `otherwise` without it.
inline int Asked(const char* name, int otherwise) {
  const char* count = std::getenv(name);
  return count == nullptr ? otherwise : std::atoi(count);
}

// Returns one of these values.
template <typename T, std::size_t n>
T OneOf(RandomStream& random, const std::array<T, n>& values) {
  return values[random.Index(static_cast<int>(n))];
}

// Returns the line of a part file for a solid that is a box.
inline std::string BoxText(const std::string& name, const Vector3& low, const Vector3& high) {
  return fmt::format("  {}: {{box: [[{}, {}, {}], [{}, {}, {}]]}}\n", name, low.x(), low.y(),
                     low.z(), high.x(), high.y(), high.z());
}

// Returns a folder of models with the stock grippers, robots and workcells, and with a folder for
// one part of its own.
inline std::filesystem::path ModelsWithPart(const std::string& folder, const std::string& part) {
  namespace fs = std::filesystem;
  const fs::path models = ScratchFile(folder);
  fs::create_directories(models / "parts" / part);
  for (const char* same : {"grippers", "robots", "workcells"}) {
    if (fs::exists(models / same)) continue;
    fs::create_directory_symlink(fs::path(ASSAY_SOURCE_DIR "/models") / same, models / same);
  }
  return models;
}

// A problem with its plan. `is_proved` says whether every precondition of the plan is proved.
struct Planned {
  domain::Problem problem;
  plan::Plan plan;
  bool is_proved = false;
};

inline Planned PlanFor(domain::Problem problem, const constraint_posting::PlannerOptions& options,
                       const constraint_posting::UncertaintyOptions& uncertainty = {}) {
  Planned planned{std::move(problem), {}, false};
  const plan::PlanResult result =
      assembly::MakeCertifiedPlan(planned.problem, options, uncertainty);
  planned.is_proved = result.outcome == Outcome::kFound && result.plan.errors == 0;
  planned.plan = result.plan;
  return planned;
}

// Every corner of the error box stays within all that is claimed. It succeeds, unless the plan
// names a way of the arm as not proved. `scene` is what a failure prints, to repeat it.
inline void ExpectToKeepItsCertificate(const Planned& planned, std::uint64_t seed, int corners,
                                       const std::string& scene) {
  const auto box = noise::ErrorBox(planned.problem, planned.plan);
  const NoiseFloor gate = MeasureNoiseFloor(planned.problem, planned.plan, {});
  const bool is_proved = plan::StepsWithUnprovedWays(planned.plan).empty();
  for (int corner = 1; corner <= corners; ++corner) {
    const noise::Noise noise =
        noise::Sample(planned.problem, box, noise::Mode::kVertices, seed, corner);
    const Trial trial =
        RunTrial({.problem = planned.problem, .plan = planned.plan, .gate = gate}, noise, {});
    if (is_proved) {
      EXPECT_EQ(trial.verdict.outcome, TrialOutcome::kSucceeded)
          << scene << "corner " << corner << ": " << trial.verdict.reason;
    }
    for (const Claim& claim : trial.claims) {
      EXPECT_FALSE(claim.IsViolated()) << scene << "corner " << corner << ": " << claim.name;
    }
  }
}

}  // namespace assay::check
