#include <algorithm>
#include <cmath>

#include "sim/execution/robots/execution.h"

// The motions of Execution without dynamics.
namespace assay::execution {
namespace {

// How often each second the engine computes the forces, while robots move without dynamics. The
// forces in the trace's samples are those of the timesteps after the samples, so that the usual
// rate of samples is best.
constexpr double kForceRate = 50;

}  // namespace

double Execution::NextForces(double now) {
  double count = std::floor(now * kForceRate);
  while (count / kForceRate < now + kRounding) ++count;
  return count / kForceRate;
}

double Execution::KinematicUntil() const {
  const double now = data_.time();
  const bool forces_are_due = NextForces(now - data_.timestep()) <= now + kRounding;
  return options_.kinematic_step <= 0 || forces_are_due || now < near_until_ ? now
                                                                             : NextForces(now);
}

// Only a full timestep of the engine computes the forces. If they have become due within the last
// timestep, this function does not move the robot, and the caller executes a full timestep. If the
// robot would touch a body, it moves by full timesteps until the forces are next due.
double Execution::MoveKinematically(const Commands& commands, double time, double end) {
  const double shortest = options_.kinematic_step;
  const double start = data_.time();
  const double stop = std::min(KinematicUntil(), end + start - time);
  if (start + shortest > stop) return time;
  if (!kinematic_.Begin(data_, world_.held(), commands(time))) return time;
  while (data_.time() < stop) {
    const double now = time + data_.time() - start;
    const double lasts = std::max(kinematic_.MayGoOn(commands(now)), shortest);
    const double next = std::min(data_.time() + lasts, stop);
    const RobotCommand command = commands(time + next - start);
    if (!kinematic_.MoveTo(command, next, data_)) {
      near_until_ = NextForces(start);
      break;
    }
    commanded_ = command.arm;
    EndTimestep();
  }
  if (data_.time() == start) {
    data_.Resume();
    return time;
  }
  kinematic_.End(data_);
  Feel(data_.time() - start);
  SampleIfDue();
  return time + data_.time() - start;
}

void Execution::PassTime(double end) {
  const double start = data_.time();
  const double until = std::min(KinematicUntil(), end);
  if (until <= start) return;
  data_.SetTime(until);
  EndTimestep();
  Feel(until - start);
  SampleIfDue();
}

void Execution::ForgetKinematics() {
  kinematic_.Forget();
  near_until_ = 0;
}

// Soft servos let the arm sag. An arm that moves steadily goes on with the lag that it has. If it
// cannot, it is asked again when the engine has computed the forces.
double Execution::GlideSoftly(const JointState& next, double seconds) {
  constexpr double kSteady = 5e-4;  // rad/s
  const JointVector lagging = scene_.ArmPosition(data_) - commanded_.q;
  const JointVector unsteady = scene_.ArmVelocity(data_) - commanded_.qd;
  const JointState before = commanded_;
  const auto between = [&](double time) -> JointVector {
    return before.q + time / seconds * (next.q - before.q);
  };
  const Commands commands = [&](double time) {
    return RobotCommand{.arm = {between(time) + lagging, next.qd}};
  };
  const double gone = unsteady.norm() < kSteady ? MoveKinematically(commands, 0, seconds) : 0;
  if (gone > 0) {
    commanded_ = {between(gone), next.qd};
  } else {
    near_until_ = NextForces(data_.time());
  }
  return gone;
}

}  // namespace assay::execution
