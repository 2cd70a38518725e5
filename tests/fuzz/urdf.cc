// The target reads a URDF file as an arm and as a gripper. The inverse kinematics of an accepted
// arm is run at a pose that the arm reaches, and may find eight solutions at most.

#include "planner/base/check.h"
#include "planner/kinematics/arm.h"
#include "planner/kinematics/gripper.h"
#include "tests/fuzz/reader_input.h"

namespace {

void SolveAtHome(const std::filesystem::path& file) {
  const auto arm = assay::kinematics::Arm::FromUrdf(file);
  const assay::kinematics::JointVector q = assay::kinematics::JointVector::Constant(0.3);
  ASSAY_CHECK(arm.Inverse(arm.Forward(q), q).size() <= 8, "more solutions than branches");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  const std::filesystem::path file = fuzz::FileOf(fuzz::TextOf(data, size), "fuzzed.urdf");
  fuzz::RefusesOrDoes([&] { SolveAtHome(file); });
  return fuzz::RefusesOrDoes([&] { kinematics::Gripper::FromUrdf(file); });
}
