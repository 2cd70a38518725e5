#include "planner/domain/workcell/workcell.h"

#include "planner/base/check.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"

namespace assay::domain {

geometry::Pose Placement::X_WorldTable() const {
  return geometry::Translation(x, y, 0) * geometry::RotationZ(yaw);
}

std::shared_ptr<const Workcell> Workcell::WithRules(const WorkcellRules& rules) const {
  auto copy = std::make_shared<Workcell>(*this);
  copy->rules_ = rules;
  return copy;
}

std::shared_ptr<const Workcell> Workcell::WithSensors(std::vector<SensorModel> sensors) const {
  auto copy = std::make_shared<Workcell>(*this);
  copy->uncertainty_operations_.sensors = std::move(sensors);
  return copy;
}

std::shared_ptr<const Workcell> Workcell::WorkedBy(RobotId robot) const {
  ASSAY_CHECK(robot.index() >= 0 && robot.index() < static_cast<int>(robots_.size()));
  auto copy = std::make_shared<Workcell>(*this);
  copy->acting_ = robot;
  return copy;
}

geometry::Pose Workcell::FlangeFor(const geometry::Pose& X_WorldTool) const {
  return X_WorldBase().inverse() * X_WorldTool * gripper().X_FlangeTool().inverse();
}

geometry::CollisionShape Workcell::HandShape(double opening) const {
  std::vector<geometry::Box> boxes = gripper().HandBoxes();
  const std::vector<geometry::Box> fingers = gripper().FingerBoxes(opening);
  boxes.insert(boxes.end(), fingers.begin(), fingers.end());
  return geometry::CollisionShape(boxes);
}

}  // namespace assay::domain
