#include "sim/check/measurements/effective_clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/problem/problem_file.h"

namespace assay::check::effective_clearance_test {
namespace {

// Returns the problem of Spar's figure 15 with another clearance, in millimetres.
domain::Problem WithClearance(double millimetres) {
  std::ifstream file(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml");
  std::stringstream text;
  text << file.rdbuf() << "clearance: " << millimetres / 25.4 << "\n";
  return domain::ReadProblem(Document::Parse(text.str(), "scenario.yaml"),
                             ASSAY_SOURCE_DIR "/models");
}

TEST(EffectiveClearance, IsTheNominalOne) {
  for (const double clearance : {0.05, 0.5, 1.0}) {
    const domain::Problem problem = WithClearance(clearance);
    for (const Play& play : EffectiveClearance(problem, domain::MatingId(0))) {
      EXPECT_NEAR(play.nominal, 2e-3 * clearance, 1e-8);
      EXPECT_LT(std::abs(play.RelativeDifference()), 0.01) << clearance << " mm";
    }
  }
}

TEST(EffectiveClearance, LooksAcrossTheHole) {
  const domain::Problem problem = WithClearance(0.5);
  const auto plays = EffectiveClearance(problem, domain::MatingId(0));
  for (const Play& play : plays) {
    EXPECT_NEAR(play.axis.dot(problem.matings[0].mating_vector), 0, 1e-12);
  }
  EXPECT_NEAR(plays[0].axis.dot(plays[1].axis), 0, 1e-12);
}

// The hole is 61 mm wide and the shaft 38 mm thick. The part's centre of mass is above the middle
// of the engaged length, so a push and a damping at different points would tilt it on its long way.
TEST(EffectiveClearance, IsTheNominalOneInAWideHole) {
  const std::filesystem::path folder = ASSAY_SOURCE_DIR "/tests/sim/check/measurements/wide-hole";
  domain::ModelPath models = folder;
  models.Append(ASSAY_SOURCE_DIR "/models");
  const domain::Problem problem =
      domain::ReadProblem(Document::Load(folder / "scenario.yaml"), models);
  const std::vector<Play> plays = EffectiveClearance(problem, domain::MatingId(0));
  ASSERT_EQ(plays.size(), 2u);
  for (const Play& play : plays) {
    EXPECT_NEAR(play.nominal, 0.023, 1e-8);
    EXPECT_NEAR(play.measured, 0.023, 1e-4);
  }
}

// The engine measures the clearance of the parts themselves, whatever the problem's figure is. Half
// the clearance gives half the play.
TEST(EffectiveClearance, IsThatOfTheParts) {
  domain::Problem problem = WithClearance(0.5);
  for (domain::Part& part : problem.parts)
    part.model = domain::PartFile::WithClearance(*part.model, 0.00025);
  for (const Play& play : EffectiveClearance(problem, domain::MatingId(0))) {
    EXPECT_NEAR(play.measured, 0.0005, 5e-6);
    EXPECT_NEAR(play.nominal, 0.0005, 1e-8);
  }
}

}  // namespace
}  // namespace assay::check::effective_clearance_test
