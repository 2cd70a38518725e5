#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/parts/part_model.h"
#include "planner/domain/units/units.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/execution/walk/executor.h"
#include "tests/planner/plan/actions.h"
#include "tests/scratch_file.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::heavy_squeeze_test {
namespace {

constexpr double kGravity = 9.81;          // m/s^2
constexpr double kGivePerNewton = 2.5e-7;  // m/N, what a certificate allows for

// Returns the peg of Spar's figure 15, made of a material that is as dense as this.
std::shared_ptr<const domain::PartModel> PegOfDensity(int density) {
  std::ifstream in(ASSAY_SOURCE_DIR "/models/parts/peg/part.yaml");
  std::stringstream text;
  text << in.rdbuf();
  const std::filesystem::path file = ScratchFile("heavy-peg.yaml");
  std::ofstream(file) << std::regex_replace(text.str(), std::regex("density: 700"),
                                            fmt::format("density: {}", density));
  return domain::PartFile::Load(file, 0.001);
}

// Executes the squeeze of a part. `off` is how far the part is off across the pads at the start, in
// metres, and `turn` by how many radians it is turned.
Trace SqueezeOf(const domain::Problem& problem, PartId part, double off, double turn) {
  const Pose& X_WorldPart = problem.part(part).X_WorldPart;
  const plan::Hold hold = HoldForMating(problem, domain::MatingId(0));
  const plan::Plan plan = {
      .problem = problem.name,
      .steps = {{"action_1", plan::Squeeze(part, hold, {"initial", X_WorldPart}), 1, 1}}};
  const scene::Scene scene(problem, {});
  mujoco::Data data = scene.Start();
  const Vector3 closing = (X_WorldPart * hold.X_PartTool).linear().col(1);
  scene.SetPart(data, part,
                geometry::Translation(closing * off) * X_WorldPart * geometry::RotationZ(turn));
  Trace trace = Execute(problem, plan, scene, data, {});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  return trace;
}

// Returns the distance of the hand from its commanded place when the pads have just closed on a
// part, in metres.
double HandOff(const Trace& trace) {
  const double closed = trace.All<GraspFact>().front()->time;
  const Sample* last = nullptr;
  for (const Sample* sample : trace.All<Sample>()) {
    if (sample->snapshot.time <= closed) last = sample;
  }
  const TrueAndBelieved& tool = last->snapshot.tool;
  return (tool.truth.translation() - tool.believed.translation()).norm();
}

// Pads that push a heavy part feel the friction of its support. An arm that is not braced would
// yield to it by micrometres per newton, and would leave the part beside the place to which the
// hand was commanded.
TEST(HeavySqueeze, TheHandStaysWhereItWasCommanded) {
  domain::Problem problem = Figure15();
  const PartId peg = PartNamed(problem, "peg");
  domain::Part& part = problem.parts[peg.index()];
  part.model = PegOfDensity(28000);
  const double friction = kGravity * part.model->mass().mass * part.model->friction();
  ASSERT_GT(friction, 15);
  for (const double off : {0.002, -0.002}) {
    for (const double turn : {0.02, -0.02}) {
      EXPECT_LE(HandOff(SqueezeOf(problem, peg, off, turn)), kGivePerNewton * friction)
          << off << " " << turn;
    }
  }
}

// A part that is heavier than others is pushed by pads as stiff as its friction requires. Pads that
// are as soft as they may be for a lighter part would leave it turned by 0.005 degrees.
TEST(HeavySqueeze, ThePartIsTurnedBackToThePads) {
  domain::Problem problem = Figure15();
  const PartId peg = PartNamed(problem, "peg");
  domain::Part& part = problem.parts[peg.index()];
  part.model = PegOfDensity(2800);
  for (const double turn : {0.02, -0.02}) {
    const Trace trace = SqueezeOf(problem, peg, 0, turn);
    const Pose& X_WorldPart = trace.All<Sample>().back()->snapshot.parts[peg.index()].truth;
    const double left =
        Eigen::AngleAxisd(X_WorldPart.linear().transpose() * part.X_WorldPart.linear()).angle();
    EXPECT_LE(left, 0.002 * domain::kDegrees.factor) << turn;
  }
}

}  // namespace
}  // namespace assay::execution::heavy_squeeze_test
