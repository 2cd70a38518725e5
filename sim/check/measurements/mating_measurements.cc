#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/domain/matings/mating_success.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "sim/check/measurements/fit.h"
#include "sim/check/measurements/measurement.h"
#include "sim/execution/trial/finding.h"

namespace assay::check {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr double kBeforeMouth = 1e-3;  // metres
constexpr int kPlacesOnWay = 16;       // points along the mating motion

// Returns the direction in which the held part is believed to move, in the world frame.
Vector3 MatingDirection(const MeasuredStep& step, const execution::Snapshot& at) {
  const Pose& X_WorldFixed = at.parts[step.mating().fixed.index()].believed;
  return (X_WorldFixed.linear() * step.mating().mating_vector).normalized();
}

// Returns the true pose of the held part in the fixed part's frame, and its direction of motion.
Motion MatingMotion(const MeasuredStep& step, const execution::Snapshot& poised) {
  const Pose X_FixedWorld = poised.parts[step.mating().fixed.index()].truth.inverse();
  return {X_FixedWorld * poised.parts[step.mating().held.index()].truth,
          X_FixedWorld.linear() * MatingDirection(step, poised)};
}

// The part reaches its seat within the guarded travel.
std::vector<MeasuredMargin> Seat(const MeasuredStep& step) {
  const execution::Snapshot* reached = step.events().reached;
  if (reached == nullptr) return {};
  const execution::TrueAndBelieved& fixed = reached->parts[step.mating().fixed.index()];
  const Pose& X_FixedHeld = step.mating().X_FixedHeld;
  return OfAll(MetOnGuardedWay(step, {.X_WorldExpected = fixed.believed * X_FixedHeld,
                                      .X_WorldEnd = fixed.truth * X_FixedHeld,
                                      .direction = MatingDirection(step, *reached)}));
}

// Returns the height of the held part's lowest point above the table, `way` from where it was
// poised.
double HeightAfter(const Vector3& way, const MeasuredStep& step,
                   const execution::Snapshot& poised) {
  double lowest = kInfinity;
  for (const Vector3& corner : step.problem().part(step.part()).model->corners()) {
    lowest = std::min(lowest, (step.PartAt(poised) * corner + way).z());
  }
  return lowest - poised.table_heights[step.mating().fixed.index()];
}

// The held part, moved along the mating motion from where it was poised, touches nothing. It is
// measured against the fixed part until the shafts come to the mouths of their holes, and against
// other parts to the end.
std::vector<MeasuredMargin> PassingClear(const MeasuredStep& step) {
  if (step.events().poised == nullptr) return {};
  const execution::Snapshot& poised = *step.events().poised;
  const domain::Problem& problem = step.problem();
  const domain::Mating& mating = step.mating();
  double depth = 0;
  for (const domain::ShaftFit& fit : domain::FitsOf(problem, mating)) {
    depth = std::max(depth, fit.depth);
  }
  const Vector3 direction = MatingDirection(step, poised);
  std::vector<MeasuredMargin> measured;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    if (domain::PartId(p) == step.part()) continue;
    const bool is_fixed = domain::PartId(p) == mating.fixed;
    const double length = mating.mating_vector.norm() - (is_fixed ? depth + kBeforeMouth : 0);
    double nearest = kInfinity;
    for (int i = 0; i <= kPlacesOnWay; ++i) {
      const Vector3 way = std::max(0.0, length) * i / kPlacesOnWay * direction;
      nearest = std::min(
          nearest,
          geometry::Distance(step.shape(), geometry::Translation(way) * step.PartAt(poised),
                             problem.parts[p].model->shape(), poised.parts[p].truth));
    }
    AddClearance(fmt::format("{} passes {} on its way in", problem.part(step.part()).name,
                             problem.parts[p].name),
                 nearest, measured);
  }
  if (mating.ends_on_table) return measured;
  const double height = HeightAfter(mating.mating_vector.norm() * direction, step, poised);
  measured.push_back(
      {.subject = fmt::format("{} passes the table on its way in", problem.part(step.part()).name),
       .observed = height,
       .is_at_least_the_margin = false});
  return measured;
}

// The certified margin includes the distance by which a compliant wrist yields to the walls. Here
// the shaft is measured as if no wall had pushed it yet. With a compliant wrist the observed margin
// may therefore be smaller than the certified one.
std::vector<MeasuredMargin> InsideWalls(const MeasuredStep& step, double FitMargins::*margin) {
  if (step.events().poised == nullptr) return {};
  const FitMargins margins =
      MarginsOfFits(step.problem(), step.mating(), MatingMotion(step, *step.events().poised));
  std::vector<MeasuredMargin> measured = OfAll(margins.*margin);
  for (MeasuredMargin& meaning : measured) {
    meaning.counts_on_yielding = step.problem().workcell->rules().lateral_compliance > 0;
    meaning.is_at_least_the_margin = !meaning.counts_on_yielding;
  }
  return measured;
}

// The shaft, moved along the mating motion from where it was poised, is inside the walls of its
// hole when its tip is in the mouth.
std::vector<MeasuredMargin> Entry(const MeasuredStep& step) {
  return InsideWalls(step, &FitMargins::entry);
}

// The shaft, moved along the mating motion from where it was poised, is inside the walls of its
// hole at its seat.
std::vector<MeasuredMargin> SlideIn(const MeasuredStep& step) {
  return InsideWalls(step, &FitMargins::slide_in);
}

// Shafts that are alike may share a precondition, and the least of its limits then holds for each.
double LeastLimit(const plan::Certificate& certificate, const std::string& subject) {
  double of_all = kInfinity;
  double of_subject = kInfinity;
  for (const plan::CertifiedPrecondition& claim : certificate.preconditions) {
    if (claim.condition != plan::condition::kTilt) continue;
    of_all = std::min(of_all, std::abs(claim.limit));
    if (claim.meaning == subject) of_subject = std::min(of_subject, std::abs(claim.limit));
  }
  return std::isfinite(of_subject) ? of_subject : of_all;
}

// The shaft's axis leans across each pair of walls by less than the limit.
std::vector<MeasuredMargin> Tilt(const MeasuredStep& step) {
  if (step.events().poised == nullptr) return {};
  std::vector<MeasuredMargin> measured;
  for (const Lean& lean :
       LeansInSlots(step.problem(), step.mating(), MatingMotion(step, *step.events().poised))) {
    const std::string subject = lean.slot + " neither touches twice nor wedges";
    measured.push_back({subject, LeastLimit(step.step().certificate, subject) - lean.sine});
  }
  return measured;
}

// Returns the pose of the tip, relative to the fixed part, that the hand's poses give.
struct TipPoses {
  Pose believed;
  Pose truth;
};
TipPoses TipAtStart(const MeasuredStep& step, const execution::Snapshot& poised) {
  const plan::Strategy& strategy = *step.step().strategy;
  const Pose X_HandTip = step.hold().X_PartTool.inverse() * strategy.X_HeldTip;
  const execution::TrueAndBelieved& fixed = poised.parts[step.mating().fixed.index()];
  return {fixed.believed.inverse() * poised.tool.believed * X_HandTip,
          fixed.truth.inverse() * step.PartAt(poised) * strategy.X_HeldTip};
}

// At the strategy's start, the tip is shifted from where it is believed to be by at most the shift
// that the strategy absorbs.
std::vector<MeasuredMargin> TipShift(const MeasuredStep& step) {
  if (step.events().poised == nullptr) return {};
  const TipPoses tip = TipAtStart(step, *step.events().poised);
  const Vector3 shift = tip.truth.translation() - tip.believed.translation();
  const Vector3& absorbed = step.step().strategy->certificate.d;
  return {{{}, (absorbed - shift.cwiseAbs()).minCoeff()}};
}

// At the strategy's start, the tip is turned from its believed orientation by at most the turn that
// the strategy absorbs.
std::vector<MeasuredMargin> TipTurn(const MeasuredStep& step) {
  if (step.events().poised == nullptr) return {};
  const TipPoses tip = TipAtStart(step, *step.events().poised);
  const Eigen::AngleAxisd turn(
      geometry::Matrix3(tip.truth.linear() * tip.believed.linear().inverse()));
  const Vector3& absorbed = step.step().strategy->certificate.w;
  return {{{}, (absorbed - (turn.angle() * turn.axis()).cwiseAbs()).minCoeff()}};
}

// A part may lie anywhere within the play of its hole, and the engine leaves it at another place
// for every timestep. Therefore only the room beyond the play is measured.
double RoomOf(const execution::Finding& finding) {
  return std::min(finding.limit - finding.value, domain::kLateralSlack);
}

// The part is as near its place as a successful assembly needs.
std::vector<MeasuredMargin> InPlace(const MeasuredStep& step) {
  if (step.events().end == nullptr) return {};
  const execution::Snapshot& end = *step.events().end;
  const domain::Mating& mating = step.mating();
  const Pose X_FixedHeld =
      end.parts[mating.fixed.index()].truth.inverse() * end.parts[mating.held.index()].truth;
  double room = RoomOf(execution::LateralError(step.problem(), mating, X_FixedHeld));
  for (std::size_t pair = 1; pair < mating.features.size(); ++pair) {
    room = std::min(room,
                    RoomOf(execution::AlignmentError(step.problem(), mating, pair, X_FixedHeld)));
  }
  // Walls prove the claim for rigid parts, so the margin is not exactly kept.
  return {{.subject = {}, .observed = room, .is_at_least_the_margin = false}};
}

// The fixed part leans by less than a part that begins to tip.
std::vector<MeasuredMargin> FixedStands(const MeasuredStep& step) {
  constexpr double kTips = 2e-3;  // radians; contacts in the engine yield by less
  const StepEvents& events = step.events();
  if (events.begun == nullptr || events.end == nullptr) return {};
  const auto up_in_fixed = [&](const execution::Snapshot& snapshot) -> Vector3 {
    const Pose& X_WorldFixed = snapshot.parts[step.mating().fixed.index()].truth;
    return X_WorldFixed.linear().row(2).transpose();
  };
  double lean = 0;
  for (const execution::Snapshot* snapshot : {events.reached, events.acted, events.end}) {
    if (snapshot == nullptr) continue;
    lean = std::max(lean, up_in_fixed(*events.begun).cross(up_in_fixed(*snapshot)).norm());
  }
  return {{.subject = {}, .observed = 1 - lean / kTips, .is_at_least_the_margin = false}};
}

}  // namespace

std::vector<Measurement> MatingMeasurements() {
  return {{plan::condition::kEntry, Entry},
          {plan::condition::kSlideIn, SlideIn},
          {plan::condition::kTilt, Tilt},
          {plan::condition::kSeat, Seat},
          {plan::condition::kPassingClear, PassingClear},
          {plan::condition::kInPlace, InPlace},
          {plan::condition::kTipShift, TipShift},
          {plan::condition::kTipTurn, TipTurn},
          {plan::condition::kFixedStands, FixedStands},
          {plan::condition::kFixedStays}};
}

}  // namespace assay::check
