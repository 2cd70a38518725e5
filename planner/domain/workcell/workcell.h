#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/domain/workcell/robot.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "planner/geometry/coordinates.h"

namespace assay::geometry {
class CollisionShape;
}  // namespace assay::geometry

namespace assay::domain {

// A table, on which parts may rest. The tops of all tables are in the plane z = 0 of the world.
struct Table {
  std::string name;
  geometry::Polygon top;  // convex, world x and y, metres
  double thickness = 0;
};

// A candidate place for a part that is put down: its stable pose is turned by yaw about the world z
// and then moved to (x, y).
struct Placement {
  double x = 0;
  double y = 0;
  double yaw = 0;
  geometry::Pose X_WorldTable() const;  // Translation(x, y, 0) * RotationZ(yaw)
};

// A named part of the table, a disc, where parts may be put down.
struct Place {
  std::string name;
  Placement middle;   // middle of the disc; parts there are turned by its yaw
  double radius = 0;  // radius of the disc that contains the origins of parts at this place, metres
  int room = 1;       // number of parts that find room
};

// The rules that the file of a workcell states once for all scenarios in this workcell.
struct WorkcellRules {
  double tool_lean = 0;          // greatest angle of the tool's z from straight down, radians
  double approach_step = 0;      // quantization of approach directions, radians
  double approach_distance = 0;  // length of the straight approach along the tool's z, metres
  double safe_height = 0;        // height of the tool for travel, metres above the table
  double friction = 0;           // friction of mating surfaces, for the friction cone
  double pad_friction = 0;
  double grip_force = 0;         // force of each pad, newtons
  double part_gap = 0;           // least horizontal gap to leave to other parts, metres
  double contact_allowance = 0;  // overlap that a geometric test ignores, metres
  double pad_margin = 0;
  // Greatest distance, in metres, by which the guarded descent of a putdown or of a mating may end
  // before or beyond the expected height. A guarded descent ends when it meets resistance, or
  // without resistance at the lowest height at which contact can occur.
  double guarded_travel = 0;
  double lateral_compliance = 0;
  // Whether the arm keeps its configuration and makes no sudden turns along straight lines. No file
  // states this rule: only the proof that no plan exists drops it.
  bool keeps_configuration = true;
};

// Tables, rules, and one or more robots. A planner of grasps and motions works with one robot, the
// one that acts: arm, gripper, base and home are its own. That is the file's first robot unless
// WorkedBy chooses another.
class Workcell {
 public:
  const std::string& name() const { return name_; }
  const std::vector<Robot>& robots() const { return robots_; }
  RobotId acting() const { return acting_; }
  const Robot& robot() const { return robots_[acting_.index()]; }  // the robot that acts
  const kinematics::Arm& arm() const { return *robot().arm; }
  const kinematics::Gripper& gripper() const { return *robot().gripper; }
  const geometry::Pose& X_WorldBase() const { return robot().X_WorldBase; }
  // Returns the first table, at which sensors and cameras look.
  const Table& table() const { return tables_.front(); }
  const std::vector<Table>& tables() const { return tables_; }  // at least one
  const WorkcellRules& rules() const { return rules_; }
  const kinematics::JointVector& home() const { return robot().home; }
  const kinematics::JointVector& joint_acceleration() const { return robot().joint_acceleration; }
  // Returns the placements at which parts may be put down, best first.
  const std::vector<Placement>& placements() const { return placements_; }
  const std::vector<Place>& places() const { return places_; }
  const UncertaintyOperations& uncertainty_operations() const { return uncertainty_operations_; }

  // Returns the flange pose, in the arm's base frame, that brings the tool to X_WorldTool.
  geometry::Pose FlangeFor(const geometry::Pose& X_WorldTool) const;

  // Returns the shape of hand and fingers with the pads `opening` metres apart, in the tool frame.
  geometry::CollisionShape HandShape(double opening) const;

  // Returns the same workcell with other rules.
  std::shared_ptr<const Workcell> WithRules(const WorkcellRules& rules) const;
  // Returns the same workcell with other sensors.
  std::shared_ptr<const Workcell> WithSensors(std::vector<SensorModel> sensors) const;
  // Returns the same workcell with this robot as the acting robot.
  std::shared_ptr<const Workcell> WorkedBy(RobotId robot) const;

 private:
  Workcell() = default;
  friend class WorkcellFile;

  std::string name_;
  std::vector<Robot> robots_;
  RobotId acting_ = RobotId(0);
  std::vector<Table> tables_;
  WorkcellRules rules_;
  std::vector<Placement> placements_;
  std::vector<Place> places_;
  UncertaintyOperations uncertainty_operations_;
};

}  // namespace assay::domain
