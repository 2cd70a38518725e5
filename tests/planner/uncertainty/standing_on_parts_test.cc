#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "planner/domain/problem/problem_file.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/uncertainty/action_lists.h"
#include "tests/scratch_file.h"

// Parts that stand on other parts, which are not where the plan has them.
namespace assay::uncertainty::standing_on_parts_test {
namespace {

namespace fs = std::filesystem;

void WritePart(const fs::path& models, const std::string& name, const std::string& rest) {
  fs::create_directories(models / "parts" / name);
  std::ofstream(models / "parts" / name / "part.yaml")
      << "format: assay-part/1\nname: " << name
      << "\nunits: {length: mm, angle: degree}\nfriction: 0.3\n"
      << rest;
}

// A plug with a flange that is `ledge` millimetres wider than its shaft on each side, and a well
// for it. An arm at a corner of the flange moves its centre of mass aside.
domain::ModelPath PlugAndWell(const std::string& test, double ledge) {
  const fs::path models = ScratchFile("standing-on-parts-" + test);
  const double half = 10.5 + ledge;
  WritePart(models, "plug",
            fmt::format(R"(initial: K
density: 1000
solids:
  head: {{box: [[{0}, {0}, 0], [{1}, {1}, 30]]}}
  arm: {{box: [[{0}, {0}, 30], [1.5, 1.5, 100]]}}
  shaft: {{box: [[-10.5, -10.5, -10], [10.5, 10.5, 0]]}}
features:
  1: {{shaft: shaft, axis: -z, what: shaft}}
  2: {{face: head, normal: +z, what: top}}
stable_poses: {{down: -z}}
)",
                        -half, half));
  WritePart(models, "well", R"(initial: L
density: 2700
solids:
  body: {box: [[-40, -40, 0], [40, 40, 50]]}
pockets:
  hole: {cut_from: body, box: [[-10.5, -10.5, 36], [10.5, 10.5, 50]], widen: [x, y]}
features:
  1: {hole: hole, axis: +z, what: hole}
  2: {face: body, normal: -z, what: under}
stable_poses: {flat: -z}
)");
  domain::ModelPath path;
  path.Append(models);
  path.Append(ASSAY_SOURCE_DIR "/models");
  return path;
}

// Returns the greatest value that the ratio of standing may have after the mating.
double StandingRatio(const domain::ModelPath& models, double clearance, double tolerance,
                     double error_of_well) {
  const std::string text = fmt::format(
      R"(format: assay-scenario/1
units: {{length: mm, angle: degree}}
workcell: puma762-table
clearance: {}
tolerances: {{clearance: {}}}
parts:
  well:
    model: well
    pose: {{stable: flat, at: [600, 100], yaw: 0}}
    error: {{x: {}, y: {}, z: 0.02, theta: 0.02}}
  plug:
    model: plug
    pose: {{stable: down, at: [500, -200], yaw: 0}}
    error: {{x: 0.05, y: 0.05, z: 0.02, theta: 0.02}}
gripper: {{error: {{x: 0.02, y: 0.02, z: 0.02, theta: 0.01}}}}
goal:
  - assembled:
      held: plug
      fixed: well
      features: [[1], [1]]
      pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 50]]}}
      mating_vector: [0, 0, -36]
)",
      clearance, tolerance, error_of_well, error_of_well);
  const domain::Problem problem = domain::ReadProblem(Document::Parse(text, "ledge.yaml"), models);
  double ratio = -1;
  for (const CertifiedAction& action : Certify(problem, FirstPlan(problem))) {
    for (const plan::CertifiedPrecondition& claim : action.certificate.preconditions) {
      if (claim.condition == plan::condition::kStanding) ratio = std::max(ratio, claim.bound);
    }
  }
  return ratio;
}

// A ledge of 1 mm beside the hole bears the plug as long as the well is not displaced by more. The
// centre of mass would be over the planned contact in any case.
TEST(StandingOnParts, ANarrowLedgeBearsNothingSurely) {
  const domain::ModelPath models = PlugAndWell("ledge", 4);
  EXPECT_LT(StandingRatio(models, 1, 0, 0.1), 1);
  EXPECT_EQ(StandingRatio(models, 3, 0, 2.7), kNothingBorne);
}

// Within the tolerance of the clearance, the whole flange may fit into the hole.
TEST(StandingOnParts, TheToleranceOfTheClearanceMovesTheRim) {
  const domain::ModelPath models = PlugAndWell("tolerance", 1.9);
  EXPECT_LT(StandingRatio(models, 1, 0, 0.05), 1);
  EXPECT_EQ(StandingRatio(models, 1, 0.9, 0.05), kNothingBorne);
}

}  // namespace
}  // namespace assay::uncertainty::standing_on_parts_test
