#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"
#include "planner/domain/parts/part_file.h"
#include "planner/geometry/pose.h"
#include "sim/scene/scene.h"
#include "tests/sim/scene/all_parts.h"

namespace assay::scene::stable_pose_drop_test {
namespace {

using domain::StablePose;

// Each computed stable pose is tested in the simulation. A part that is dropped from 2 mm and
// tilted by up to a degree must come to rest in that stable pose.
class StablePosesOf : public testing::TestWithParam<std::string> {};

constexpr double kDropHeight = 0.002;  // metres
// A drop can carry a part over an edge if the pose has little margin. A part in such a pose is set
// down instead.
constexpr double kLittleMargin = 6 * kDegree;
constexpr double kSetDownHeight = 0.0001;  // metres
constexpr double kLargestTilt = kDegree;   // of the disturbance
constexpr double kSeconds = 1.0;
constexpr double kMostSeconds = 6.0;  // until tall and slender parts have stopped rocking
constexpr double kAtRest = 0.002;     // rad/s
constexpr int kDrops = 3;
const geometry::Pose kMiddle = geometry::Translation(0.7, 0, 0);

// Returns the pose in which a long part lies across the table, which is longer in that direction.
geometry::Pose Across(const StablePose& pose, const domain::PartModel& model) {
  Eigen::AlignedBox3d box;
  for (const Vector3& vertex : model.corners()) box.extend(pose.X_TablePart * vertex);
  const double yaw = box.sizes().x() > box.sizes().y() ? std::numbers::pi / 2 : 0;
  const Vector3 center(box.center().x(), box.center().y(), 0);
  return kMiddle * geometry::RotationZ(yaw) * geometry::Translation(-center) * pose.X_TablePart;
}

geometry::Pose Disturbed(const StablePose& pose, const domain::PartModel& model,
                         RandomStream& random) {
  const double direction = random.Uniform(0, 2 * std::numbers::pi);
  const Vector3 axis(std::cos(direction), std::sin(direction), 0);
  const geometry::Pose tilt(Eigen::AngleAxisd(random.Uniform(0, kLargestTilt), axis));
  const geometry::Pose X_WorldPart = Across(pose, model);
  geometry::Pose X = kMiddle * tilt * kMiddle.inverse() * X_WorldPart;
  double lowest = 1;
  for (const Vector3& vertex : model.corners()) lowest = std::min(lowest, (X * vertex).z());
  const double height = pose.tilt_margin < kLittleMargin ? kSetDownHeight : kDropHeight;
  return geometry::Translation(0, 0, height - lowest) * X;
}

void ComeToRest(const Scene& scene, mujoco::Data& data) {
  const double start = data.time();
  const auto is_moving = [&] {
    return scene.TrueTwist(data, domain::PartId(0)).angular.norm() > kAtRest;
  };
  while (data.time() < start + kSeconds || (is_moving() && data.time() < start + kMostSeconds)) {
    data.Step();
  }
}

// Returns the angle, in the part's frame, between the directions that point down in the two poses.
double AngleFrom(const StablePose& pose, const geometry::Pose& X_WorldPart) {
  const Vector3 down_now = X_WorldPart.linear().row(2);
  const Vector3 down_then = pose.X_TablePart.linear().row(2);
  return std::atan2(down_now.cross(down_then).norm(), down_now.dot(down_then));
}

TEST_P(StablePosesOf, SurviveADrop) {
  const auto model =
      domain::PartFile::Load(ModelsFolder() / "parts" / GetParam() / "part.yaml", 0.0005);
  domain::Problem problem = ProblemWith({});
  domain::Part& part = problem.parts.emplace_back();
  part.name = GetParam();
  part.model = model;
  part.X_WorldPart = kMiddle;
  const Scene scene(problem, {.timestep = 0.001});
  mujoco::Data data = scene.Start();
  RandomStream random(7, "drop " + GetParam());
  ASSERT_FALSE(model->stable_poses().empty());
  for (const StablePose& pose : model->stable_poses()) {
    for (int drop = 0; drop < kDrops; ++drop) {
      scene.SetPart(data, domain::PartId(0), Disturbed(pose, *model, random));
      ComeToRest(scene, data);
      const double angle = AngleFrom(pose, scene.TruePose(data, domain::PartId(0)));
      EXPECT_LT(angle, 0.5 * kDegree)
          << pose.label << " " << pose.name << ", drop " << drop << " of seed 7, tipping margin "
          << pose.tilt_margin / kDegree << " degrees";
    }
  }
  EXPECT_TRUE(data.Warnings().empty());
}

INSTANTIATE_TEST_SUITE_P(Parts, StablePosesOf, testing::ValuesIn(AllParts()), [](const auto& part) {
  std::string name = part.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace assay::scene::stable_pose_drop_test
