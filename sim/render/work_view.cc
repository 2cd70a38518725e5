#include "sim/render/work_view.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

#include "planner/base/check.h"
#include "planner/geometry/box.h"

namespace assay::render {
namespace {

Vector3 MiddleOf(const std::vector<Ball>& balls) {
  Vector3 middle = Vector3::Zero();
  for (const Ball& ball : balls) middle += ball.center / static_cast<double>(balls.size());
  return middle;
}

// Returns the corners of a box, or a ball about any other geom.
std::vector<Ball> OutlineOf(const mjModel& model, const mjData& data, int geom) {
  const Vector3 center = Eigen::Map<const Vector3>(data.geom_xpos + 3 * geom);
  if (model.geom_type[geom] != mjGEOM_BOX) return {{center, model.geom_rbound[geom]}};
  geometry::Box box;
  box.X_FrameBox.translation() = center;
  box.X_FrameBox.linear() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data.geom_xmat + 9 * geom);
  box.half_extents = Eigen::Map<const Vector3>(model.geom_size + 3 * geom);
  std::vector<Ball> corners;
  for (const Vector3& corner : box.Corners()) corners.push_back({corner});
  return corners;
}

// Returns balls that contain hand and fingers, for each robot.
std::vector<std::vector<Ball>> HandsOf(const scene::Scene& scene, const mujoco::Data& data) {
  const mjModel& model = *data.model().get();
  std::map<int, std::vector<Ball>> hands;  // by the id of the robot's root body
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int body = model.geom_bodyid[geom];
    if (scene.KindOf(mujoco::BodyId(body)) != scene::BodyKind::kHand) continue;
    std::ranges::move(OutlineOf(model, *data.get(), geom),
                      std::back_inserter(hands[model.body_rootid[body]]));
  }
  std::vector<std::vector<Ball>> all;
  for (auto& [root, balls] : hands) all.push_back(std::move(balls));
  return all;
}

}  // namespace

std::vector<Ball> WorkOutline(const domain::Problem& problem, const scene::Scene& scene,
                              const std::vector<domain::PartId>& parts, const mujoco::Data& data) {
  ASSAY_CHECK(!parts.empty());
  std::vector<Ball> framed;
  for (const domain::PartId part : parts) {
    std::ranges::move(CornersOf(*problem.part(part).model, scene.TruePose(data, part)),
                      std::back_inserter(framed));
  }
  const Vector3 middle = MiddleOf(framed);
  const std::vector<std::vector<Ball>> hands = HandsOf(scene, data);
  std::ranges::copy(std::ranges::min(hands, {},
                                     [&](const std::vector<Ball>& hand) {
                                       return (MiddleOf(hand) - middle).norm();
                                     }),
                    std::back_inserter(framed));
  return framed;
}

FreeCamera WorkView(const domain::Problem& problem, const scene::Scene& scene,
                    const std::vector<domain::PartId>& parts, const mujoco::Data& data,
                    double aspect) {
  return Framing(WorkOutline(problem, scene, parts, data), UsualDirection(), aspect);
}

Subject GraspOf(const domain::Problem& problem, const scene::Scene& scene, domain::PartId part,
                const mujoco::Data& data) {
  const Pose X_WorldTool = scene.ToolPose(data);
  Subject subject{.framed = CornersOf(*problem.part(part).model, scene.TruePose(data, part)),
                  .out = -X_WorldTool.linear().col(2),
                  .from_out = {std::numbers::pi / 2, std::numbers::pi / 2.4, std::numbers::pi / 3}};
  for (const Ball& corner : subject.framed) subject.seen.push_back({corner.center});
  for (const geometry::Box& box : problem.workcell->gripper().FingerBoxes(scene.Opening(data))) {
    for (const Vector3& corner : box.Transformed(X_WorldTool).Corners()) {
      subject.framed.push_back({corner});
    }
  }
  return subject;
}

}  // namespace assay::render
