#include "sim/execution/robots/execution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <set>

#include "planner/base/stop.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/motion/paths/carrying.h"
#include "planner/motion/paths/torque_limits.h"
#include "sim/execution/control/straight_line.h"

namespace assay::execution {
namespace {

// Forces of stiff contacts jump from step to step, so only a force that lasts stops the arm.
constexpr double kBraced = 16;         // share of the usual stiffness of a braced arm's servos
constexpr double kForceFilter = 0.02;  // time constant of the force that stops the arm, seconds
constexpr double kPeakFilter = 0.002;  // time constant of the greatest force, seconds
// Time constant of the force that ends a guarded move, seconds.
constexpr double kTouchFilter = 0.001;
constexpr double kBrakeTime = 0.002;  // seconds from slow motion to rest
// Forces that have changed move bodies within this time, seconds. What has not moved for so long
// does not move until the robot does.
constexpr double kStandsFor = 0.01;

using BodyNames = std::pair<std::string, std::string>;

std::vector<BodyNames> ContactPairs(const mujoco::Data& data) {
  std::set<BodyNames> pairs;
  for (const mujoco::Contact& contact : mujoco::Contacts(data)) {
    const std::string a = data.model().Name(contact.body_a);
    const std::string b = data.model().Name(contact.body_b);
    pairs.insert(std::minmax(a, b));
  }
  return {pairs.begin(), pairs.end()};
}

// Returns the contact points of these pairs of bodies. The forces of the simulation's contacts must
// be valid.
std::vector<ContactPoint> ContactPoints(const mujoco::Data& data,
                                        const std::vector<BodyNames>& pairs) {
  std::vector<ContactPoint> points;
  for (const mujoco::Contact& contact : mujoco::Contacts(data)) {
    const std::string a = data.model().Name(contact.body_a);
    const std::string b = data.model().Name(contact.body_b);
    const auto pair = std::ranges::find(pairs, BodyNames(std::minmax(a, b)));
    if (pair == pairs.end()) continue;
    const double sign = a < b ? 1 : -1;
    points.push_back({static_cast<std::size_t>(pair - pairs.begin()), contact.position,
                      sign * contact.normal, sign * contact.force_on_b});
  }
  std::ranges::stable_sort(points, {}, &ContactPoint::pair);
  return points;
}

// Returns null if there is no sample. Few other events follow a sample.
Sample* LastSample(Trace& trace) {
  for (TraceEvent& event : std::views::reverse(trace.events)) {
    if (auto* const sample = std::get_if<Sample>(&event)) return sample;
  }
  return nullptr;
}

Trace EmptyTrace(const domain::Problem& problem) {
  Trace trace{.problem = problem.name};
  for (const domain::Part& part : problem.parts) trace.parts.push_back(part.name);
  return trace;
}

// Returns the trajectory, slowed down as far as a part in the hand and the arm's motors require.
// Returns nothing if the motors cannot carry the weight.
std::optional<JointTrajectory> AsCarried(const JointTrajectory& asked,
                                         const domain::Problem& problem, const WorldModel& world) {
  const domain::Robot& robot = problem.workcell->robot();
  if (world.held().IsNone()) return motion::WithinTorques(asked, robot, std::nullopt);
  const geometry::MassProperties& mass = problem.part(world.held()).model->mass();
  const Pose X_ToolPart = world.hold().X_PartTool.inverse();
  const kinematics::Inertial held = {
      .mass = mass.mass,
      .X_LinkCenter = X_ToolPart * geometry::Translation(mass.center),
      .inertia = mass.inertia};
  return motion::WithinTorques(motion::Carrying(asked, *problem.workcell, X_ToolPart * mass.center),
                               robot, held);
}

Failure TooHeavy() {
  return {TrialOutcome::kTooHeavy,
          "the motors of the arm cannot carry the weight of the arm and of what it holds"};
}

}  // namespace

Execution::Execution(const domain::Problem& problem, const scene::Scene& scene, mujoco::Data& data,
                     const ExecutorOptions& options)
    : problem_(problem),
      scene_(scene),
      data_(data),
      options_(options),
      servo_(scene),
      world_(problem),
      collisions_(scene),
      kinematic_(scene),
      trace_(EmptyTrace(problem)),
      commanded_{scene.ArmPosition(data), JointVector::Zero()},
      force_limit_(options.force_limit) {}

Pose Execution::BelievedTool() const {
  return ToolAt(*problem_.workcell, commanded_.q) * hand_error_.inverse();
}

Pose Execution::MeasuredTool() const {
  return ToolAt(*problem_.workcell, scene_.ArmPosition(data_)) * hand_error_.inverse();
}

motion::Surroundings Execution::BelievedSurroundings() const {
  motion::Surroundings around{.opening = scene_.Opening(data_)};
  for (int i = 0; i < world_.part_count(); ++i) {
    const PartId part(i);
    if (part != world_.held()) around.parts.push_back({part, world_.PartPose(part)});
  }
  if (!world_.held().IsNone()) {
    around.held = motion::HeldPart{world_.held(), world_.hold().X_PartTool};
  }
  const domain::Workcell& workcell = *problem_.workcell;
  for (std::size_t i = 0; i < workcell.robots().size(); ++i) {
    const domain::RobotId robot(i);
    if (robot == workcell.acting()) continue;
    around.robots.push_back(
        {robot, scene_.ArmPosition(data_, robot), scene_.Opening(data_, robot)});
  }
  return around;
}

void Execution::Place(const JointVector& q) {
  scene_.SetArm(data_, q);
  commanded_ = {q, JointVector::Zero()};
}

Snapshot Execution::Now() const {
  const Pose X_WorldTool = BelievedTool();
  Snapshot now{.time = data_.time(),
               .tool = {scene_.ToolPose(data_), X_WorldTool},
               .opening = scene_.Opening(data_),
               .wrist = scene_.WristWrench(data_),
               .contacts = ContactPairs(data_)};
  for (int i = 0; i < world_.part_count(); ++i) {
    now.parts.push_back(
        {scene_.TruePose(data_, PartId(i)), world_.PartPose(PartId(i), X_WorldTool)});
    now.table_heights.push_back(scene_.TableHeight(data_, PartId(i)));
  }
  for (std::size_t i = 0; i < problem_.workcell->robots().size(); ++i) {
    now.arms.push_back(scene_.Posture(data_, domain::RobotId(i)));
  }
  return now;
}

// Moves in joint space to the nearest joint values that bring the tool there.
Progress Execution::TakeUpHandError(const Pose& error) {
  const domain::Workcell& workcell = *problem_.workcell;
  const Pose X_WorldTool = BelievedTool() * error;
  hand_error_ = error;
  const auto nearest = motion::NearestPosture(workcell, X_WorldTool, commanded_.q);
  if (!nearest) return Failure{TrialOutcome::kUnreachable, "the arm cannot take up an error"};
  const JointTrajectory way =
      motion::SynchronizedMove(commanded_.q, *nearest, motion::RatesOf(workcell));
  return Follow(way);
}

// The arm has the commanded state at the beginning of each timestep. At the end of the timestep,
// the arm is therefore where the trajectory is one timestep later.
Progress Execution::Follow(const JointTrajectory& asked) {
  const std::optional<JointTrajectory> carried = AsCarried(asked, problem_, world_);
  if (!carried) return TooHeavy();
  const JointTrajectory& trajectory = *carried;
  Relax();
  const Commands commands = [&](double time) { return RobotCommand{.arm = trajectory.At(time)}; };
  ForgetKinematics();
  double time = 0;
  while (time < trajectory.duration()) {
    time = MoveKinematically(commands, time, trajectory.duration()) + data_.timestep();
    if (Progress failure = StepTo(trajectory.At(time))) return failure;
  }
  return std::nullopt;
}

// Resistance is a force that was not there before the move. Once stiff bodies touch, it grows by
// newtons in each timestep, so a light filter against ripple suffices. The arm brakes along its
// line. If each joint stopped in its own time, the joints would drag aside what the hand presses
// on. At the end the servos are commanded to hold the arm where it is, so that it stops pressing.
Progress Execution::Follow(const JointTrajectory& trajectory, const Guarded& guarded) {
  const double from = data_.time();
  Relax();
  const double before = scene_.WristWrench(data_).force.dot(guarded.direction);
  double resistance = 0;
  const Commands commands = [&](double time) { return RobotCommand{.arm = trajectory.At(time)}; };
  ForgetKinematics();
  double time = 0;
  double rate = 1;  // rate at which the trajectory's time passes
  while (time < trajectory.duration() && rate > 0) {
    if (rate == 1) time = MoveKinematically(commands, time, trajectory.duration());
    if (rate < 1 || resistance >= guarded.force)
      rate = std::max(0.0, rate - data_.timestep() / kBrakeTime);
    time += rate * data_.timestep();
    const JointState along = trajectory.At(time);
    if (Progress failure = StepTo({along.q, rate * along.qd})) return failure;
    const double against = before - scene_.WristWrench(data_).force.dot(guarded.direction);
    resistance += std::min(1.0, data_.timestep() / kTouchFilter) * (against - resistance);
  }
  const bool stopped = rate < 1;
  if (stopped) TakeStock();
  trace_.events.push_back(
      GuardRecord{data_.time(), stopped, BelievedTool(), from, guarded.force, guarded.direction});
  return std::nullopt;
}

Progress Execution::Stay(double seconds, const std::function<void()>& see) {
  const JointState rest{commanded_.q, JointVector::Zero()};
  const double end = data_.time() + seconds;
  double moved_at = data_.time();
  do {
    if (Progress failure = StepTo(rest)) return failure;
    if (see) see();
    if (!kinematic_.EverythingStands(data_)) moved_at = data_.time();
    if (data_.time() >= moved_at + kStandsFor) PassTime(end);
  } while (data_.time() < end);
  return std::nullopt;
}

Progress Execution::MoveFingers(double opening, double rate,
                                const std::function<bool()>& has_ended) {
  const double from = scene_.Opening(data_);
  const double duration = std::abs(opening - from) / rate;
  const JointState rest{commanded_.q, JointVector::Zero()};
  const Commands commands = [&](double time) {
    const double share = std::min(1.0, time / duration);
    return RobotCommand{rest, from + share * (opening - from), std::copysign(rate, opening - from)};
  };
  ForgetKinematics();
  double time = 0;
  while (time < duration) {
    time = MoveKinematically(commands, time, duration) + data_.timestep();
    scene_.CommandGripper(data_, commands(time).opening);
    if (Progress failure = StepTo(rest)) return failure;
    if (has_ended && has_ended()) break;
  }
  return std::nullopt;
}

bool Execution::IsInHand() const {
  if (world_.held().IsNone()) return false;
  return scene_.Touching(data_, world_.held(), scene_.left_finger()) ||
         scene_.Touching(data_, world_.held(), scene_.right_finger());
}

void Execution::TakeStock() { commanded_ = {scene_.ArmPosition(data_), JointVector::Zero()}; }

Checkpoint Execution::Save() const {
  return {data_.Save(), world_, commanded_, felt_, is_braced_, hand_error_};
}

void Execution::Restore(const Checkpoint& checkpoint) {
  data_.Restore(checkpoint.state);
  world_ = checkpoint.world;
  commanded_ = checkpoint.commanded;
  felt_ = checkpoint.felt;
  is_braced_ = checkpoint.is_braced;
  hand_error_ = checkpoint.hand_error;
  // The samples that were due until here have been taken.
  samples_ = 0;
  while (IsSampleDue()) ++samples_;
}

// The servo's law is linear in its command. If the command is a state between the arm's own and the
// wanted one, or beyond it, the servo behaves as if its gains were lower or higher. Damping is
// scaled by the root of the stiffness, so the arm is as well damped as before.
JointState Execution::WithStiffness(double share, const JointState& wanted) const {
  const JointVector q = scene_.ArmPosition(data_);
  const JointVector qd = scene_.ArmVelocity(data_);
  return {q + share * (wanted.q - q), qd + std::sqrt(share) * (wanted.qd - qd)};
}

// The accelerations by which the arm yields to forces get no feedforward torques. Most of such a
// torque would serve to accelerate the motor itself. A touched body would prevent this
// acceleration, and would then exert a force of the size of the torque on the arm.
Progress Execution::StepSoftly(const JointState& next, const JointVector& qdd, double share) {
  Relax();
  servo_.Command(data_, WithStiffness(share, next), qdd, Carried());
  return Advance(next);
}

Progress Execution::StepTo(const JointState& next) {
  const JointVector qdd = (next.qd - commanded_.qd) / data_.timestep();
  servo_.Command(data_, is_braced_ ? WithStiffness(kBraced, commanded_) : commanded_, qdd,
                 Carried());
  return Advance(next);
}

Progress Execution::Advance(const JointState& next) {
  StepEngine();
  commanded_ = next;
  EndTimestep();
  SampleIfDue();
  RecordCollisions();
  return Watch();
}

void Execution::EndTimestep() {
  StopIfRequested();
  ++steps_;
  if (options_.on_timestep) options_.on_timestep(data_);
  if (options_.observer != nullptr) options_.observer->SeeTimestep(data_);
}

// Returns the held part's weight as far as the wrist feels it. The table, or the part on which it
// is put, may carry the rest.
scene::Load Execution::Carried() const {
  if (world_.held().IsNone()) return {};
  const geometry::MassProperties& mass = problem_.part(world_.held()).model->mass();
  const double weight = mass.mass * scene::kGravity;
  return {.force = {0, 0, std::clamp(felt_.z(), -weight, 0.0)},
          .at = world_.PartPose(world_.held(), scene_.ToolPose(data_)) * mass.center};
}

// The engine computes the forces of contacts in the timestep that begins with these contacts. The
// sample that was taken at the start of the timestep then gets these forces.
void Execution::StepEngine() {
  Sample* const sample = options_.sample_rate > 0 ? LastSample(trace_) : nullptr;
  const bool lacks_forces = sample != nullptr && sample->snapshot.time == data_.time();
  data_.Step([&] {
    kinematic_.SeeForces(data_, world_.held());
    if (lacks_forces) sample->contact_points = ContactPoints(data_, sample->snapshot.contacts);
  });
}

bool Execution::IsSampleDue() const {
  return options_.sample_rate > 0 && data_.time() + kRounding >= samples_ / options_.sample_rate;
}

void Execution::SampleIfDue() {
  if (!IsSampleDue()) return;
  trace_.events.push_back(Sample{Now()});
  // Another robot may have acted for long.
  while (IsSampleDue()) ++samples_;
}

void Execution::RecordCollisions() {
  for (const Collision& collision : collisions_.Look(data_, world_.held())) {
    trace_.events.push_back(CollisionRecord{data_.time(), data_.model().Name(collision.robot),
                                            data_.model().Name(collision.other)});
  }
}

Progress Execution::Watch() {
  if (data_.HasWarnings()) {
    const mujoco::EngineWarning warning = data_.Warnings().front();
    return Failure{TrialOutcome::kEngineWarning,
                   fmt::format("{} ({} times)", warning.text, warning.count)};
  }
  Feel(data_.timestep());
  if (felt_.norm() <= force_limit_) return std::nullopt;
  const Vector3 p = 1e3 * scene_.ToolPose(data_).translation();
  return Failure{TrialOutcome::kOverload,
                 fmt::format("the wrist felt {:.0f} N, more than {:.0f} N, with the tool at "
                             "({:.1f}, {:.1f}, {:.1f}) mm",
                             felt_.norm(), force_limit_, p.x(), p.y(), p.z())};
}

void Execution::Feel(double seconds) {
  const Vector3 force = scene_.WristWrench(data_).force;
  felt_ += std::min(1.0, seconds / kForceFilter) * (force - felt_);
  peak_ += std::min(1.0, seconds / kPeakFilter) * (force - peak_);
  greatest_force_ = std::max(greatest_force_, peak_.norm());
}

}  // namespace assay::execution
