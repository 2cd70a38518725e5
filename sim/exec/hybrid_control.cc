#include "sim/exec/hybrid_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/exec/straight_line.h"
#include "sim/scene/servo_gains.h"

namespace assay::exec {
namespace {

constexpr double kGreatestTurn = 0.05;  // radians of a joint in one timestep
constexpr double kStalled = 0.3;        // seconds without way along a crevice
constexpr double kSeated = 0.002;       // metres from a crevice's end, which is not known better

using Vector6 = HybridControl::Vector6;

Vector3 RotationVector(const geometry::Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

geometry::Matrix3 Rotation(const Vector3& vector) {
  const double angle = vector.norm();
  if (angle < 1e-15) return geometry::Matrix3::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

Vector6 Joined(const Vector3& a, const Vector3& b) {
  Vector6 joined;
  joined << a, b;
  return joined;
}

}  // namespace

std::string_view Name(MatingOutcome outcome) {
  switch (outcome) {
    case MatingOutcome::kDone:
      return "done";
    case MatingOutcome::kJammed:
      return "jammed";
    case MatingOutcome::kWedged:
      return "wedged";
    case MatingOutcome::kWrongContact:
      return "wrong-contact";
    case MatingOutcome::kTimeout:
      return "timeout";
    case MatingOutcome::kOverload:
      return "overload";
    case MatingOutcome::kUnreachable:
      return "unreachable";
    case MatingOutcome::kDropped:
      return "dropped";
    case MatingOutcome::kEngineWarning:
      return "engine-warning";
  }
  return {};
}

MatingOutcome OutcomeOf(ExecutionOutcome outcome) {
  switch (outcome) {
    case ExecutionOutcome::kOverload:
      return MatingOutcome::kOverload;
    case ExecutionOutcome::kEngineWarning:
      return MatingOutcome::kEngineWarning;
    case ExecutionOutcome::kDone:
      return MatingOutcome::kDone;
    case ExecutionOutcome::kUnreachable:
    case ExecutionOutcome::kNotFound:
    case ExecutionOutcome::kOperatorCalled:
      return MatingOutcome::kUnreachable;
  }
  return MatingOutcome::kUnreachable;
}

HybridControl::HybridControl(const plan::Strategy& strategy, PartId fixed, const ControlLaw& law,
                             Execution& execution)
    : strategy_(strategy),
      law_(law),
      execution_(execution),
      X_WorldFixed_(execution.world().PartPose(fixed)),
      X_TipTool_(strategy.X_HeldTip.inverse() * execution.world().hold().X_PartTool),
      configuration_(execution.problem().workcell->arm().IndicatorsOf(execution.commanded())),
      X_FixedTip_(X_WorldFixed_.inverse() * execution.BelievedTool() * X_TipTool_.inverse()) {
  ease_.bottomRightCorner<3, 3>() /= law.lever * law.lever;
  compliance_ = ArmCompliance() / law.softness;
}

StrategyEnd HybridControl::Run(const MotionObserver& observer) {
  observer_ = observer;
  for (std::size_t i = 0; i < strategy_.motions.size(); ++i) {
    motion_ = static_cast<int>(i);
    if (Ended end = RunMotion(i)) return *end;
  }
  return {.motion = motion_};
}

HybridControl::Way HybridControl::WayOf(std::size_t motion) const {
  const Pose& from =
      motion == 0 ? strategy_.X_FixedStart : strategy_.motions[motion - 1].X_FixedTip;
  const Pose& to = strategy_.motions[motion].X_FixedTip;
  const Vector3 shift = to.translation() - from.translation();
  const Vector3 turn = RotationVector(to.linear() * from.linear().transpose());
  const double speed = SpeedOf(strategy_.motions[motion]);
  const double turning_speed =
      strategy_.motions[motion].until ? law_.contact_turning_speed : law_.turning_speed;
  return {.twist = Joined(shift, turn),
          .duration = std::max(shift.norm() / speed, turn.norm() / turning_speed)};
}

double HybridControl::SpeedOf(const plan::StrategyMotion& motion) const {
  if (motion.until) return law_.contact_speed;
  return motion.kept.empty() && !motion.slides ? law_.free_speed : law_.sliding_speed;
}

HybridControl::Rows HybridControl::RowsOf(std::span<const int> contacts) const {
  Rows rows(static_cast<Eigen::Index>(contacts.size()), 6);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& contact = strategy_.contacts[static_cast<std::size_t>(contacts[i])];
    rows.row(static_cast<Eigen::Index>(i)) =
        Joined(contact.normal, contact.at.cross(contact.normal)).transpose();
  }
  return rows;
}

// What presses on a contact is commanded to be beyond it.
bool HybridControl::LetsGo(std::size_t motion) const {
  if (motion == 0) return false;
  const plan::StrategyMotion& before = strategy_.motions[motion - 1];
  const std::vector<int>& kept = strategy_.motions[motion].kept;
  const auto is_kept = [&](int contact) { return std::ranges::find(kept, contact) != kept.end(); };
  return !std::ranges::all_of(before.kept, is_kept) || (before.until && !is_kept(*before.until));
}

HybridControl::Ended HybridControl::RunMotion(std::size_t index) {
  const plan::StrategyMotion& motion = strategy_.motions[index];
  const Way way = WayOf(index);
  if (way.duration == 0) return std::nullopt;
  if (LetsGo(index)) TakeStock();
  if (motion.slides) return Slide(way);
  return motion.until ? MoveUntil(motion, way) : MoveAlong(motion, way);
}

HybridControl::Ended HybridControl::MoveAlong(const plan::StrategyMotion& motion, const Way& way) {
  const Rows rows = RowsOf(motion.kept);
  const double dt = execution_.data().timestep();
  for (double time = 0; time < way.duration; time += dt) {
    if (Ended end = Step(Hybrid(rows, way.twist / way.duration))) return end;
    if (Ended end = CheckObstruction(rows)) return end;
  }
  return Settle(motion.kept);
}

// The contact that is waited for is told from those that are kept, and from friction, by the force
// that each of them would have to bear for what is felt.
HybridControl::Ended HybridControl::MoveUntil(const plan::StrategyMotion& motion, const Way& way) {
  const Rows kept = RowsOf(motion.kept);
  std::vector<int> after = motion.kept;
  after.push_back(*motion.until);
  const Rows rows = RowsOf(after);
  const double dt = execution_.data().timestep();
  double felt = 0;  // seconds
  const double longest = (1 + motion.beyond) * way.duration;
  for (double time = 0; time < longest + law_.settling; time += dt) {
    const Vector6 wanted = time < longest ? Vector6(way.twist / way.duration) : Vector6::Zero();
    if (Ended end = Step(Hybrid(kept, wanted))) return end;
    const bool touches = ForcesOn(rows)[rows.rows() - 1] > law_.touching_force;
    felt = touches ? felt + dt : 0;
    if (felt > law_.touch_duration) {
      TakeStock();
      BelieveAt(motion.X_FixedTip);
      return Settle(after);
    }
    if (Ended end = CheckObstruction(rows)) return end;
  }
  const auto& awaited = strategy_.contacts[static_cast<std::size_t>(*motion.until)];
  return End(MatingOutcome::kTimeout, fmt::format("no contact of {}", awaited.name));
}

HybridControl::Ended HybridControl::CheckObstruction(const Rows& rows) {
  const double force = Unexplained(rows);
  obstructed_ = force > law_.obstructing_force ? obstructed_ + execution_.data().timestep() : 0;
  if (obstructed_ <= law_.obstruction_duration) return std::nullopt;
  return End(MatingOutcome::kWrongContact,
             fmt::format("{:.0f} N that no contact of the plan explains", force));
}

// In a crevice there is one way to go, and the walls show it: the hand gives way to all that is
// felt across it. Along it, it is the slower the more resists, so that the walls have time.
HybridControl::Ended HybridControl::Slide(const Way& way) {
  const double length = way.twist.norm();
  const Vector6 direction = way.twist / length;
  const double dt = execution_.data().timestep();
  double gone = 0;
  double stalled = 0;
  while (gone < length + kSeated && stalled < kStalled) {
    const double resistance = std::max(0.0, -direction.dot(wrench_));
    const double near =
        length - gone < law_.seating_length ? law_.contact_speed / law_.sliding_speed : 1;
    const double rate = near * std::clamp(1 - resistance / law_.pushing_force, 0.0, 1.0);
    const Vector6 across = wrench_ - direction * direction.dot(wrench_);
    Vector6 yielding = law_.relaxation * compliance_ * across;
    yielding -= direction * direction.dot(yielding);
    if (Ended end = Step(rate * length / way.duration * direction + yielding)) return end;
    gone += dt * direction.dot(velocity_);
    stalled = rate < 0.02 * near ? stalled + dt : 0;
  }
  if (length - gone < kSeated) return std::nullopt;
  return Stuck(direction, length - gone);
}

// Jammed or wedged (Whitney 1982): a wedged part holds itself between the walls, whatever the hand
// does.
HybridControl::Ended HybridControl::Stuck(const Vector6& direction, double left) {
  constexpr double kBack = 0.002;  // metres
  const double dt = execution_.data().timestep();
  for (double gone = 0; gone < kBack; gone += dt * law_.contact_speed) {
    if (Ended end = Step(-law_.contact_speed * direction)) return end;
    if (direction.dot(wrench_) > law_.obstructing_force) {
      return End(MatingOutcome::kWedged, fmt::format("stuck {:.1f} mm before its end", 1e3 * left));
    }
  }
  return End(MatingOutcome::kJammed, fmt::format("stuck {:.1f} mm before its end", 1e3 * left));
}

HybridControl::Ended HybridControl::Settle(std::vector<int> contacts) {
  const Rows rows = RowsOf(contacts);
  const double dt = execution_.data().timestep();
  for (double time = 0; time < law_.settling; time += dt) {
    if (Ended end = Step(Hybrid(rows, Vector6::Zero()))) return end;
  }
  return std::nullopt;
}

// With the arm's ease W of moving, J W J' is how contacts open under each other's forces.
HybridControl::Vector6 HybridControl::Hybrid(const Rows& rows, const Vector6& wanted) const {
  if (rows.rows() == 0) return wanted;
  const Eigen::Matrix<double, 6, Eigen::Dynamic> give = ease_ * rows.transpose();
  const Eigen::LDLT<Eigen::MatrixXd> opening((rows * give).eval());
  const Eigen::VectorXd excess =
      ForcesOn(rows) - Eigen::VectorXd::Constant(rows.rows(), law_.pressing_force);
  const Eigen::VectorXd opens = (law_.relaxation * rows * compliance_ * rows.transpose() * excess)
                                    .cwiseMax(-law_.seeking_speed)
                                    .cwiseMin(law_.yielding_speed);
  const Eigen::VectorXd rates = opens - rows * wanted;
  return wanted + give * opening.solve(rates);
}

Eigen::VectorXd HybridControl::ForcesOn(const Rows& rows) const {
  const Eigen::Matrix<double, 6, Eigen::Dynamic> give = ease_ * rows.transpose();
  return (rows * give).eval().ldlt().solve(give.transpose() * wrench_);
}

double HybridControl::Unexplained(const Rows& rows) const {
  if (rows.rows() == 0) return wrench_.head<3>().norm();
  return (wrench_ - rows.transpose() * ForcesOn(rows)).head<3>().norm();
}

void HybridControl::TakeStock() {
  execution_.TakeStock();
  X_FixedTip_ = X_WorldFixed_.inverse() * execution_.BelievedTool() * X_TipTool_.inverse();
  velocity_.setZero();
}

void HybridControl::BelieveAt(const Pose& X_FixedTip) {
  X_FixedTip_ = X_FixedTip;
  X_TipTool_ = X_FixedTip.inverse() * X_WorldFixed_.inverse() * execution_.BelievedTool();
}

HybridControl::Ended HybridControl::Step(const Vector6& twist) {
  const double dt = execution_.data().timestep();
  velocity_ += std::min(1.0, dt / law_.velocity_filter) * (twist - velocity_);
  X_FixedTip_.translation() += dt * velocity_.head<3>();
  X_FixedTip_.linear() = Rotation(dt * velocity_.tail<3>()) * X_FixedTip_.linear();
  const auto q = JointsFor(execution_.Erring(X_WorldFixed_ * X_FixedTip_ * X_TipTool_));
  if (!q) return End(MatingOutcome::kUnreachable, "the arm cannot follow");
  const JointVector qd = (*q - execution_.commanded()) / dt;
  if (Progress failure = execution_.StepSoftly({*q, qd}, law_.softness)) {
    return End(OutcomeOf(failure->outcome), failure->reason);
  }
  Feel();
  if (observer_) observer_(execution_.data(), motion_);
  return std::nullopt;
}

// J K^-1 J', with the arm's Jacobian at the tip by differences and the servos' stiffness.
HybridControl::Matrix6 HybridControl::ArmCompliance() const {
  constexpr double kTurn = 1e-5;  // radians
  const domain::Workcell& workcell = *execution_.problem().workcell;
  const auto tip_at = [&](const JointVector& q) {
    return X_WorldFixed_.inverse() * ToolAt(workcell, q) * X_TipTool_.inverse();
  };
  const JointVector q = execution_.commanded();
  const Pose X_FixedTip = tip_at(q);
  Matrix6 compliance = Matrix6::Zero();
  for (int joint = 0; joint < 6; ++joint) {
    JointVector turned = q;
    turned[joint] += kTurn;
    const Pose X = tip_at(turned);
    const Vector6 column = Joined(X.translation() - X_FixedTip.translation(),
                                  RotationVector(X.linear() * X_FixedTip.linear().transpose())) /
                           kTurn;
    compliance +=
        column * column.transpose() / scene::kServoGains[static_cast<std::size_t>(joint)].stiffness;
  }
  return compliance;
}

std::optional<JointVector> HybridControl::JointsFor(const Pose& X_WorldTool) const {
  const domain::Workcell& workcell = *execution_.problem().workcell;
  const JointVector& now = execution_.commanded();
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), now)) {
    if (s.indicators != configuration_) continue;
    const auto q = workcell.arm().NearestInRange(s.q, now);
    if (q && (*q - now).cwiseAbs().maxCoeff() < kGreatestTurn) return q;
  }
  return std::nullopt;
}

// The wrench of the contacts on the held part: what the wrist feels, without the part's weight.
void HybridControl::Feel() {
  const scene::Scene& scene = execution_.scene();
  mujoco::Data& data = execution_.data();
  const WorldModel& world = execution_.world();
  const Pose X_WorldTool = scene.ToolPose(data);
  const Pose X_WorldHeld = world.PartPose(world.held(), X_WorldTool);
  const auto& mass = execution_.problem().part(world.held()).model->mass();
  const Vector3 tip = (X_WorldFixed_ * X_FixedTip_).translation();
  const Vector3 load =
      -mass.mass * (scene::kGravity * Vector3::UnitZ() + scene.HandAcceleration(data));
  const scene::Wrench wrist = scene.WristWrenchInMotion(data);
  const Vector3 flange = X_WorldTool *
                         execution_.problem().workcell->gripper().X_FlangeTool().inverse() *
                         Vector3::Zero();
  const Vector3 force = wrist.force - load;
  const Vector3 torque = wrist.torque + (flange - tip).cross(wrist.force) -
                         (X_WorldHeld * mass.center - tip).cross(load);
  const geometry::Matrix3 R = X_WorldFixed_.linear().transpose();
  const double share = std::min(1.0, data.timestep() / law_.wrench_filter);
  wrench_ += share * (Joined(R * force, R * torque) - wrench_);
  greatest_force_ = std::max(greatest_force_, wrench_.head<3>().norm());
}

StrategyEnd HybridControl::End(MatingOutcome outcome, std::string reason) const {
  return {outcome, fmt::format("motion {}: {}", motion_, reason), motion_};
}

}  // namespace assay::exec
