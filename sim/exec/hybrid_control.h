#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "planner/plan/strategy.h"
#include "sim/exec/execution.h"

namespace assay::exec {

// How a mating by a strategy ended, as far as the arm can tell.
enum class MatingOutcome {
  kDone,           // every motion was made
  kJammed,         // it stopped short of its end; without the push it is free
  kWedged,         // it stopped short of its end, and cannot be drawn back either
  kWrongContact,   // something touched that was not to
  kTimeout,        // a contact that was to end a motion did not come
  kOverload,       // the wrist felt more force than it may: protective stop
  kUnreachable,    // the arm cannot go on
  kDropped,        // the part is no longer in the hand
  kEngineWarning,  // the engine's numbers cannot be trusted
};
std::string_view Name(MatingOutcome outcome);  // "wrong-contact"
MatingOutcome OutcomeOf(ExecutionOutcome outcome);

// The numbers of hybrid control. Lengths in metres, forces in newtons, times in seconds.
struct ControlLaw {
  double free_speed = 0.02;            // of motions that nothing is to touch in, m/s
  double contact_speed = 0.004;        // of motions that a contact ends, m/s
  double sliding_speed = 0.01;         // along a crevice, and where contacts are kept, m/s
  double seating_length = 0.004;       // before a crevice's end, where it is as slow as to touch
  double turning_speed = 0.12;         // rad/s
  double contact_turning_speed = 0.1;  // of motions that a contact ends, rad/s
  double pressing_force = 4;           // on each contact that is kept
  double pushing_force = 12;           // along a crevice, at most
  double touching_force = 3;           // on a contact that counts as made
  double obstructing_force = 15;       // that no contact explains
  double lever = 0.2;                  // of a turn that is as easy as a shift
  double softness = 0.03;              // share of the servos' stiffness
  double relaxation = 40;              // of forces that are too much, 1/s
  double seeking_speed = 0.002;        // of a contact that is lost, m/s
  double yielding_speed = 0.005;       // to a force that is too much, m/s
  double wrench_filter = 0.002;        // time constants
  double velocity_filter = 0.01;
  double touch_duration = 0.004;       // for which a contact must be felt
  double obstruction_duration = 0.05;  // longer than an impact takes
  double settling = 0.1;               // after each motion
};

struct StrategyEnd {
  MatingOutcome outcome = MatingOutcome::kDone;
  std::string reason = {};  // empty if done
  int motion = 0;           // the one that it ended in
};

// Told of each timestep: the simulation after it, and the motion's index.
using MotionObserver = std::function<void(const mujoco::Data&, int)>;

// Runs strategies by hybrid control of position and force (Dakin and Popplestone, section 2): in
// each contact state the arm is moved along the tangents as the plan has it, and along the normals
// as forces ask for, so that contacts are kept although it is not known exactly where they are.
//
// A contact's row J = (n, r x n) is both the direction of its force and, by the principle of
// virtual work, the speed at which a twist opens it. The arm is rigid and told positions, so force
// control is an admittance: it gives way with a velocity in proportion to what the force is too
// much. What it gives way goes into the commanded position and is not undone later.
class HybridControl {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

  // The part in the execution's hand goes where the strategy leads, seen from `fixed`. The tool
  // is where the strategy starts. All must outlive this.
  HybridControl(const plan::Strategy& strategy, PartId fixed, const ControlLaw& law,
                Execution& execution);

  StrategyEnd Run(const MotionObserver& observer = {});

  double greatest_force() const { return greatest_force_; }  // at the wrist, so far

 private:
  // A straight way, as a twist in the fixed part's axes about the tip: metres and radians.
  struct Way {
    Vector6 twist = Vector6::Zero();
    double duration = 0;
  };
  using Ended = std::optional<StrategyEnd>;  // none: it goes on

  Way WayOf(std::size_t motion) const;
  double SpeedOf(const plan::StrategyMotion& motion) const;
  // What is felt that the contacts do not explain, for longer than an impact takes.
  Ended CheckObstruction(const Rows& rows);
  Rows RowsOf(std::span<const int> contacts) const;

  // Whether a contact that was made before is not kept in this motion.
  bool LetsGo(std::size_t motion) const;
  Ended RunMotion(std::size_t index);
  Ended MoveAlong(const plan::StrategyMotion& motion, const Way& way);
  Ended MoveUntil(const plan::StrategyMotion& motion, const Way& way);
  Ended Slide(const Way& way);
  Ended Settle(std::vector<int> contacts);
  Ended Stuck(const Vector6& direction, double left);

  // The twist that presses on the contacts of these rows, and otherwise follows `wanted`.
  Vector6 Hybrid(const Rows& rows, const Vector6& wanted) const;
  // The forces on contacts, as far as they can tell them apart.
  Eigen::VectorXd ForcesOn(const Rows& rows) const;
  // What is felt that no contact of these rows explains, newtons.
  double Unexplained(const Rows& rows) const;

  // The commanded position is now where the tip is: soft servos lag.
  void TakeStock();
  // The contacts tell where the tip is, better than the hand knows: turns are about that point from
  // now on.
  void BelieveAt(const Pose& X_FixedTip);
  // One timestep with this twist.
  Ended Step(const Vector6& twist);
  Matrix6 ArmCompliance() const;
  std::optional<JointVector> JointsFor(const Pose& X_WorldTool) const;
  void Feel();
  StrategyEnd End(MatingOutcome outcome, std::string reason) const;

  const plan::Strategy& strategy_;
  const ControlLaw& law_;
  Execution& execution_;
  MotionObserver observer_;
  Pose X_WorldFixed_;
  Pose X_TipTool_;
  Matrix6 ease_ = Matrix6::Identity();  // of shifts and turns
  Matrix6 compliance_;                  // of the arm, as soft as it is; m/N, rad/(N m)
  kinematics::Indicators configuration_;
  Pose X_FixedTip_;  // where the tip is believed to be
  Vector6 velocity_ = Vector6::Zero();
  Vector6 wrench_ = Vector6::Zero();  // on the held part, about the tip, fixed part's axes
  double greatest_force_ = 0;
  double obstructed_ = 0;  // seconds, without a break
  int motion_ = 0;
};

}  // namespace assay::exec
