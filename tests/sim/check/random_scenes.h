#pragma once

#include <cstdlib>
#include <filesystem>

#include "planner/assembly/certified_plan.h"
#include "planner/domain/problem/problem_file.h"
#include "tests/scratch_file.h"

// What the tests on random scenes share.
namespace assay::check {

// Returns the number in the environment variable `name`, or `otherwise` without it.
inline int Asked(const char* name, int otherwise) {
  const char* count = std::getenv(name);
  return count == nullptr ? otherwise : std::atoi(count);
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

inline Planned PlanFor(domain::Problem problem, const constraint_posting::PlannerOptions& options) {
  Planned planned{std::move(problem), {}, false};
  const plan::PlanResult result = assembly::MakeCertifiedPlan(planned.problem, options, {});
  planned.is_proved = result.outcome == Outcome::kFound && result.plan.errors == 0;
  planned.plan = result.plan;
  return planned;
}

}  // namespace assay::check
