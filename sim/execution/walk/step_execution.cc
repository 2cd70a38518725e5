#include "sim/execution/walk/step_execution.h"

#include <algorithm>
#include <limits>

#include "planner/base/check.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "sim/execution/commands/command_file.h"
#include "sim/execution/commands/run.h"
#include "sim/execution/walk/recovery.h"

namespace assay::execution {
namespace {

// Computes the direction along which the tool comes. Across it, the place of a part can be wrong.
Vector3 AxisOf(const domain::Problem& problem, const WorldModel& world,
               const plan::Action& action) {
  if (action.mating.IsNone()) return Vector3::UnitZ();
  const domain::Mating& mating = problem.mating(action.mating);
  return (world.PartPose(mating.fixed).linear() * mating.mating_vector).normalized();
}

// Distances from a rim, in metres. The rim is where it was felt, but the part may lean and the rim
// may not be level.
constexpr double kBackOff = 0.0005;
constexpr double kBeyondRim = 0.0003;
constexpr double kArmRest = 0.05;  // seconds for the arm to come to rest

// Returns the end of the last move of the commands.
Pose LastTarget(const std::vector<Command>& commands) {
  Pose target = Pose::Identity();
  for (const Command& command : commands) {
    if (const auto* line = std::get_if<MoveStraight>(&command)) target = line->X_WorldTool;
    if (const auto* move = std::get_if<MoveAtSafeHeight>(&command)) target = move->X_WorldTool;
    if (const auto* path = std::get_if<FollowPath>(&command)) target = path->X_WorldTool;
  }
  return target;
}

}  // namespace

StepExecution::StepExecution(const plan::Plan& plan, plan::StepId step, Execution& execution)
    : plan_(plan),
      planned_(plan.step(step)),
      step_(step),
      execution_(execution),
      sought_(plan::PlacedPart(execution.problem(), planned_.action)),
      X_WorldSought_(execution.world().PartPose(sought_)),
      axis_(AxisOf(execution.problem(), execution.world(), planned_.action)),
      commands_(CommandsFor(execution.problem(), execution.world(), plan, step)),
      X_WorldTool_(LastTarget(commands_.advance)) {
  execution_.SetStep(step);
  execution_.Handle(HandledParts());
}

// Includes the part that the hand holds all the while, for example when a sensor looks at another
// part.
std::vector<PartId> StepExecution::HandledParts() const {
  std::vector<PartId> parts = {sought_};
  if (!execution_.world().held().IsNone()) parts.push_back(execution_.world().held());
  return parts;
}

const std::vector<Command>& StepExecution::CommandsOf(Phase phase) const {
  switch (phase) {
    case Phase::kApproach:
      return commands_.approach;
    case Phase::kAdvance:
      return commands_.advance;
    case Phase::kAct:
      return commands_.act;
    case Phase::kDepart:
      return commands_.depart;
  }
  ASSAY_CHECK(false, "a phase that the switch does not know");
  return commands_.approach;
}

std::vector<Command> StepExecution::After(Phase phase) const {
  std::vector<Command> commands;
  for (const Phase later : {Phase::kAdvance, Phase::kAct, Phase::kDepart}) {
    if (later <= phase) continue;
    const std::vector<Command>& of_phase = CommandsOf(later);
    commands.insert(commands.end(), of_phase.begin(), of_phase.end());
  }
  return commands;
}

Progress StepExecution::RunAll(const std::vector<Command>& commands,
                               const std::vector<Command>& then) {
  std::vector<Command> all = commands;
  all.insert(all.end(), then.begin(), then.end());
  const std::span<const Command> span(all);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const auto run = [&](const auto& command) {
      return execution::Run(command, span.subspan(i + 1), execution_);
    };
    if (Progress failure = std::visit(run, commands[i])) return failure;
  }
  return std::nullopt;
}

Progress StepExecution::Run(Phase phase) { return RunAll(CommandsOf(phase), After(phase)); }

Progress StepExecution::Named(Progress failure) const {
  if (failure) failure->reason = planned_.name + ": " + failure->reason;
  return failure;
}

// A part that is put down finds the table at the height that was drawn for the place. A part that
// is mated is over the table of the fixed part. Where the hand works on a part, it meets the table
// of this part.
void StepExecution::SetTables() {
  const scene::Scene& scene = execution_.scene();
  mujoco::Data& data = execution_.data();
  if (planned_.action.Is(domain::kSense)) return;
  const std::optional<double> drawn = execution_.options().noise.TableHeight(step_);
  const double height = drawn.value_or(scene.TableHeight(data, sought_));
  if (drawn) scene.SetTableHeight(data, sought_, height);
  if (!execution_.world().held().IsNone()) {
    scene.SetTableHeight(data, execution_.world().held(), height);
  }
  scene.SetTableHeightUnderHand(data, height);
}

void StepExecution::Record(Stage stage) {
  const Milestone milestone{step_, stage, execution_.Now()};
  execution_.trace().events.push_back(milestone);
  Observer* const observer = execution_.options().observer;
  if (observer != nullptr) observer->SeeMilestone(milestone, execution_.data());
}

Progress StepExecution::Approach() {
  execution_.SetHandError(execution_.options().noise.HandError(step_));
  SetTables();
  if (Progress failure = Run(Phase::kApproach)) return Named(failure);
  Record(Stage::kPoised);
  return std::nullopt;
}

Progress StepExecution::TakeUpNoise() {
  SetTables();
  const Pose error = execution_.options().noise.HandError(step_);
  if (Progress failure = execution_.TakeUpHandError(error)) return Named(failure);
  if (Progress failure = execution_.Stay(kArmRest)) return Named(failure);
  Record(Stage::kPoised);
  return std::nullopt;
}

Progress StepExecution::Work() {
  if (Progress failure = Attempt()) return failure;
  return Complete();
}

Progress StepExecution::Complete() {
  for (std::string error = Verify(); !error.empty(); error = Verify()) {
    if (Progress failure = TryAgain(error)) return failure;
  }
  return Finish();
}

Progress StepExecution::Advance() {
  if (Progress failure = Run(Phase::kAdvance)) return Named(failure);
  Record(Stage::kReached);
  return std::nullopt;
}

Progress StepExecution::Attempt() {
  if (Progress failure = Advance()) return failure;
  if (Progress failure = Run(Phase::kAct)) return Named(failure);
  Record(Stage::kActed);
  return std::nullopt;
}

Progress StepExecution::Finish() {
  if (Progress failure = Run(Phase::kDepart)) return Named(failure);
  const StepEnd end{step_, planned_.name, plan::ShortText(execution_.problem(), planned_.action),
                    execution_.Now()};
  execution_.trace().events.push_back(end);
  Observer* const observer = execution_.options().observer;
  if (observer != nullptr) observer->SeeStepEnd(end, execution_.data());
  return std::nullopt;
}

double StepExecution::Measure(domain::MeasuredQuantity quantity) const {
  switch (quantity) {
    case domain::MeasuredQuantity::kGripperOpening:
      return execution_.scene().Opening(execution_.data());
    case domain::MeasuredQuantity::kToolHeight:
      return execution_.BelievedTool().translation().z();
  }
  ASSAY_CHECK(false, "a quantity that the switch does not know");
  return 0;
}

std::string StepExecution::Verify() {
  for (const plan::Verification& check : plan_.verifications) {
    if (check.step != step_) continue;
    VerificationRecord record{.time = execution_.data().time(),
                              .step = step_,
                              .name = check.name,
                              .measured = Measure(check.quantity),
                              .expected = check.expected,
                              .tolerance = check.tolerance,
                              .error = {}};
    if (record.measured < check.expected - check.tolerance) record.error = check.below;
    if (record.measured > check.expected + check.tolerance) record.error = check.above;
    execution_.trace().events.push_back(record);
    if (!record.error.empty()) return record.error;
  }
  return {};
}

Progress StepExecution::TryAgain(const std::string& error) {
  const std::vector<Vector3> places = PlacesFor(error);
  const std::size_t next = tried_[error]++;
  RecoveryRecord record{.time = execution_.data().time(),
                        .step = step_,
                        .error = error,
                        .strategy = domain::RecoveryStrategy::kCallOperator};
  if (next >= places.size()) {
    execution_.trace().events.push_back(record);
    return Named(Failure{TrialOutcome::kOperatorCalled,
                         error + (places.empty() ? "" : ", and no attempt to mend it succeeded")});
  }
  record.strategy = RecoveryFrom(error)->strategy;
  record.attempt = static_cast<int>(next) + 1;
  record.offset = places[next];
  execution_.trace().events.push_back(record);
  return Named(TryAt(places[next]));
}

const plan::Recovery* StepExecution::RecoveryFrom(const std::string& error) const {
  const auto found = std::ranges::find_if(plan_.recoveries, [&](const plan::Recovery& recovery) {
    return recovery.step == step_ && recovery.error == error;
  });
  return found == plan_.recoveries.end() ? nullptr : &*found;
}

std::vector<Vector3> StepExecution::PlacesFor(const std::string& error) const {
  const plan::Recovery* const recovery = RecoveryFrom(error);
  if (recovery == nullptr || !execution_.options().recovers) return {};
  std::vector<Vector3> places = PlacesToTry(*recovery, axis_);
  const double gap = execution_.problem().workcell->rules().part_gap;
  const double enough = std::min(gap, RoomAt(Vector3::Zero()));
  std::erase_if(places, [&](const Vector3& offset) { return RoomAt(offset) < enough; });
  return places;
}

double StepExecution::RoomAt(const Vector3& offset) const {
  const domain::Problem& problem = execution_.problem();
  const kinematics::Gripper& gripper = problem.workcell->gripper();
  const geometry::CollisionShape hand = problem.workcell->HandShape(gripper.max_opening());
  const Pose X_WorldTool = geometry::Translation(offset) * X_WorldTool_;
  const std::vector<PartId> handled = HandledParts();
  double room = std::numeric_limits<double>::infinity();
  for (int i = 0; i < execution_.world().part_count(); ++i) {
    const PartId part(i);
    if (std::ranges::count(handled, part) > 0) continue;
    room = std::min(room, geometry::Distance(hand, X_WorldTool, problem.part(part).model->shape(),
                                             execution_.world().PartPose(part)));
  }
  return room;
}

// A held part that stopped at the rim of a hole is lifted a little and moved sideways. From there
// the part is pushed on, unless it meets the rim again. The way down to the rim is therefore made
// only once.
Progress StepExecution::TryAt(const Vector3& offset) {
  if (Progress failure = Withdraw()) return failure;
  execution_.world().Believe(sought_, geometry::Translation(offset) * X_WorldSought_);
  commands_ = CommandsFor(execution_.problem(), execution_.world(), plan_, step_);
  if (Progress failure = MoveSideways()) return failure;
  if (commands_.withdraw.empty()) {
    if (Progress failure = Probe()) return failure;
    if (execution_.trace().All<GuardRecord>().back()->resisted) return std::nullopt;
  }
  if (Progress failure = Run(Phase::kAdvance)) return failure;
  return Run(Phase::kAct);
}

// Probes slowly, because each rim that the part runs into pushes it up in the pads.
Progress StepExecution::Probe() {
  const Vector3 way = (kBackOff + kBeyondRim) * Direction();
  const Pose beyond = geometry::Translation(way) * execution_.BelievedTool();
  return RunAll({MoveStraight{beyond, kProbingPace, Guard{kResistance}}}, {});
}

Progress StepExecution::Withdraw() {
  if (!commands_.withdraw.empty()) return RunAll(commands_.withdraw, {});
  const Pose back = geometry::Translation(-kBackOff * Direction()) * execution_.BelievedTool();
  return RunAll({MoveStraight{back, kGropingPace}}, {});
}

// Moves the tool to the line of the advance, at its present distance along that line.
Progress StepExecution::MoveSideways() {
  const Vector3 direction = Direction();
  Pose beside = LastTarget(commands_.advance);
  const Vector3 behind = execution_.BelievedTool().translation() - beside.translation();
  beside.translation() += direction * direction.dot(behind);
  return RunAll({MoveStraight{beside, kGropingPace, Guard{kResistance}}}, {});
}

// Returns the direction in which the tool advances.
Vector3 StepExecution::Direction() const {
  const Pose from = LastTarget(commands_.approach);
  const Pose to = LastTarget(commands_.advance);
  return (to.translation() - from.translation()).normalized();
}

}  // namespace assay::execution
