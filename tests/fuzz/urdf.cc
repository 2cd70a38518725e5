// The target reads a URDF file as an arm of a workcell, as an arm of any axes, and as a gripper.
// The inverse kinematics of an accepted arm is run at a pose that the arm reaches. Each solution
// must reach the pose.

#include "planner/base/check.h"
#include "planner/kinematics/arm.h"
#include "planner/kinematics/grippers/gripper.h"
#include "planner/kinematics/inverse/chain_inverse.h"
#include "tests/fuzz/reader_input.h"

namespace {

void SolveAtHome(const std::filesystem::path& file) {
  const auto arm = assay::kinematics::Arm::FromUrdf(file);
  const assay::kinematics::JointVector q = assay::kinematics::JointVector::Constant(0.3);
  const assay::kinematics::Pose X = arm.Forward(q);
  ASSAY_CHECK(X.isApprox(arm.LinkPoses(q).back(), 1e-6), "the flange is not the last link");
  for (const auto& solution : arm.Inverse(X, q)) {
    const double error = (arm.Forward(solution.q).matrix() - X.matrix()).cwiseAbs().maxCoeff();
    ASSAY_CHECK(error < 1e-8, "a solution misses the pose");
  }
}

void SolveAnyArm(const std::filesystem::path& file, bool general) {
  using namespace assay::kinematics;
  const auto chain = SerialChain::FromModel(ReadUrdf(file, UrdfContents::kAxes));
  const ChainVector q = ChainVector::Constant(chain.size(), 0.3);
  const Pose X = chain.Forward(q);
  const int locked = chain.size() == 7 ? 2 : -1;
  const SerialChain six = locked < 0 ? chain : chain.Locked(locked, q[locked]);
  if (!general && !ClassOf(six).IsExact()) return;
  if (!general && ClassOf(six).kind == ArmKind::kGeneral) return;
  for (const SixAngles& solution : ChainInverse(six).Solve(X)) {
    const double error = (six.Forward(solution).matrix() - X.matrix()).cwiseAbs().maxCoeff();
    ASSAY_CHECK(error < 1e-9, "a solution misses the pose");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  const std::string text = fuzz::TextOf(data, size);
  const std::filesystem::path file = fuzz::FileOf(text, "fuzzed.urdf");
  fuzz::RefusesOrDoes([&] { SolveAtHome(file); });
  fuzz::RefusesOrDoes([&] { SolveAnyArm(file, fuzz::IsOneIn(40, text)); });
  return fuzz::RefusesOrDoes([&] { kinematics::Gripper::FromUrdf(file); });
}
