#include "sim/check/geometric_meaning.h"

#include <algorithm>
#include <cmath>

#include "planner/domain/resting.h"
#include "sim/check/fit.h"

namespace assay::check {
namespace {

using domain::PartId;
using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// What a step does with which part.
struct Handling {
  PartId part;
  const plan::Hold* hold;
};

struct HandlingOf {
  const domain::Problem& problem;

  Handling operator()(const plan::Assemble& assemble) const {
    return {problem.mating(assemble.mating).held, &assemble.hold};
  }
  Handling operator()(const plan::Sense& sense) const { return {sense.part, nullptr}; }
  Handling operator()(const auto& action) const { return {action.part, &action.hold}; }
};

class Meaning {
 public:
  Meaning(const domain::Problem& problem, const plan::PlannedStep& step, const StepEvents& events)
      : problem_(problem),
        step_(step),
        events_(events),
        gripper_(problem.workcell->gripper()),
        handling_(std::visit(HandlingOf{problem}, step.action)) {}

  // The grasp frame of the true part in the frame of the true tool.
  Pose GraspInTool(const exec::Moment& moment) const {
    return moment.tool.truth.inverse() * PartAt(moment) * handling_.hold->X_PartTool;
  }

  double BetweenFingers(const exec::Moment& reached) const {
    const Pose X_ToolGrasp = GraspInTool(reached);
    double worst = kInfinity;
    for (const double side : {-0.5, 0.5}) {
      const Vector3 contact = X_ToolGrasp * Vector3(0, side * handling_.hold->width, 0);
      worst = std::min(worst, reached.opening / 2 - std::abs(contact.y()));
    }
    return worst;
  }

  double FingerClear(const exec::Moment& reached) const {
    const Pose X_GraspTool = GraspInTool(reached).inverse();
    const Vector2& pad = gripper_.pad_half_extents();
    double worst = kInfinity;
    for (const double x : {-pad.x(), pad.x()}) {
      for (const double z : {-pad.y(), pad.y()}) {
        for (const double side : {-1.0, 1.0}) {
          const Vector3 corner = X_GraspTool * Vector3(x, side * reached.opening / 2, z);
          worst = std::min(worst, side * corner.y() - handling_.hold->width / 2);
        }
      }
    }
    return worst;
  }

  double Fingertip(const exec::Moment& reached) const {
    double lowest = kInfinity;
    const double opening = std::clamp(reached.opening, 0.0, gripper_.max_opening());
    for (const geometry::Box& box : gripper_.FingerBoxes(opening)) {
      for (const Vector3& corner : box.Corners()) {
        lowest = std::min(lowest, (reached.tool.truth * corner).z());
      }
    }
    return lowest - reached.table_heights[handling_.part.index()];
  }

  double PadContact(const exec::Moment& acted) const {
    const Vector3 p = GraspInTool(acted).translation();
    const Vector2& pad = gripper_.pad_half_extents();
    const double margin = problem_.workcell->rules().pad_margin;
    return std::min(pad.x() - margin - std::abs(p.x()), pad.y() - margin - std::abs(p.z()));
  }

  // How far from where it was expected the guarded motion met something, at most the guarded travel
  // off; beyond it, if it met nothing.
  double MetOnGuardedWay(const exec::Moment& reached, const Pose& X_WorldExpected,
                         const Vector3& direction) const {
    const double travel = problem_.workcell->rules().guarded_travel;
    const Pose X_WorldTool = X_WorldExpected * handling_.hold->X_PartTool;
    const double beyond =
        direction.dot(reached.tool.believed.translation() - X_WorldTool.translation());
    if (!events_.resisted.value_or(false)) return std::min(0.0, travel - std::abs(beyond)) - travel;
    return travel - std::abs(beyond);
  }

  double Footprint(const exec::Moment& end) const {
    const domain::Part& part = problem_.part(handling_.part);
    const Pose X_WorldPart = PartAt(end);
    const geometry::Polygon& top = domain::TableUnder(*problem_.workcell, part, X_WorldPart).top;
    double worst = kInfinity;
    for (const Vector3& vertex : part.model->hull().vertices) {
      const Vector3 p = X_WorldPart * vertex;
      if (p.z() > end.table_heights[handling_.part.index()] + kStandsOn) continue;
      for (std::size_t i = 0; i < top.size(); ++i) {
        const Vector2 edge = (top[(i + 1) % top.size()] - top[i]).normalized();
        const Vector2 from = p.head<2>() - top[i];
        worst = std::min(worst, edge.x() * from.y() - edge.y() * from.x());
      }
    }
    return worst;
  }

  double NeighbourClear(const exec::Moment& at) const {
    double nearest = kInfinity;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (PartId(p) == handling_.part) continue;
      nearest = std::min(
          nearest, geometry::Distance(problem_.part(handling_.part).model->shape(), PartAt(at),
                                      problem_.parts[p].model->shape(), at.parts[p].truth));
    }
    // Shapes that overlap are at no distance; what only just keeps clear is at some.
    return nearest > 0 ? nearest : -kOverlap;
  }

  // Where the hand acts, or where it was stopped on its way.
  double HandClear() const {
    double nearest = kInfinity;
    for (const exec::Moment* moment : {events_.reached, events_.acted, events_.stopped}) {
      if (moment != nullptr) nearest = std::min(nearest, HandClearAt(*moment));
    }
    return nearest;
  }
  double HandClearAt(const exec::Moment& at) const {
    const double opening = std::clamp(at.opening, 0.0, gripper_.max_opening());
    const geometry::CollisionShape hand = problem_.workcell->HandShape(opening);
    double nearest = kInfinity;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (PartId(p) == handling_.part || PartId(p) == FixedPart()) continue;
      nearest = std::min(nearest,
                         geometry::Distance(hand, at.tool.truth, problem_.parts[p].model->shape(),
                                            at.parts[p].truth));
    }
    return nearest > 0 ? nearest : -kOverlap;
  }

  const domain::Mating& mating() const {
    return problem_.mating(std::get<plan::Assemble>(step_.action).mating);
  }
  // Along which the held part goes, world frame, as it is believed.
  Vector3 MatingDirection(const exec::Moment& at) const {
    return (at.parts[mating().fixed.index()].believed.linear() * mating().mating_vector)
        .normalized();
  }
  // The true pose of the held part in the fixed one's frame, and the direction in which it moves.
  Motion MatingMotion(const exec::Moment& poised) const {
    const Pose X_FixedWorld = poised.parts[mating().fixed.index()].truth.inverse();
    return {X_FixedWorld * poised.parts[mating().held.index()].truth,
            X_FixedWorld.linear() * MatingDirection(poised)};
  }
  // Where the strategy starts: the true tip against the believed one, as the fixed part sees both.
  GeometricMeaning TipError(const exec::Moment& poised, bool of_turn) const {
    const plan::Strategy& strategy = *step_.strategy;
    const Pose X_HandTip = handling_.hold->X_PartTool.inverse() * strategy.X_HeldTip;
    const exec::TrueAndBelieved& fixed = poised.parts[mating().fixed.index()];
    const Pose believed = fixed.believed.inverse() * poised.tool.believed * X_HandTip;
    const Pose truth = fixed.truth.inverse() * PartAt(poised) * strategy.X_HeldTip;
    const Eigen::AngleAxisd turn(geometry::Matrix3(truth.linear() * believed.linear().inverse()));
    const Vector3 shift = truth.translation() - believed.translation();
    const plan::StrategyCertificate& absorbed = strategy.certificate;
    if (!of_turn) return {"m", (absorbed.d - shift.cwiseAbs()).minCoeff()};
    return {"rad", (absorbed.w - (turn.angle() * turn.axis()).cwiseAbs()).minCoeff()};
  }
  double TiltLimit() const {
    double limit = kInfinity;
    for (const plan::CertifiedPrecondition& claim : step_.certificate.preconditions) {
      if (claim.condition == "tilt") limit = std::min(limit, std::abs(claim.limit));
    }
    return limit;
  }

  static constexpr double kStandsOn = 1e-3;  // metres above the table
  static constexpr double kOverlap = 1e-3;   // metres, of unknown depth

 private:
  PartId FixedPart() const {
    return std::holds_alternative<plan::Assemble>(step_.action) ? mating().fixed : PartId::None();
  }
  const Pose& PartAt(const exec::Moment& moment) const {
    return moment.parts[handling_.part.index()].truth;
  }

  const domain::Problem& problem_;
  const plan::PlannedStep& step_;
  const StepEvents& events_;
  const kinematics::Gripper& gripper_;
  Handling handling_;
};

std::optional<GeometricMeaning> InMetres(double observed) {
  if (!std::isfinite(observed)) return std::nullopt;
  return GeometricMeaning{"m", observed};
}

std::optional<GeometricMeaning> OfGrasp(const std::string& condition, const Meaning& meaning,
                                        const StepEvents& events) {
  if (events.reached == nullptr) return std::nullopt;
  if (condition == "between fingers") return InMetres(meaning.BetweenFingers(*events.reached));
  if (condition == "finger clear") return InMetres(meaning.FingerClear(*events.reached));
  if (condition == "fingertip") return InMetres(meaning.Fingertip(*events.reached));
  if (condition != "pad contact" || events.acted == nullptr) return std::nullopt;
  return InMetres(meaning.PadContact(*events.acted));
}

std::optional<GeometricMeaning> OfLanding(const std::string& condition, const Meaning& meaning,
                                          const plan::Putdown& putdown, const StepEvents& events) {
  if (events.reached == nullptr) return std::nullopt;
  if (condition == "landing height") {
    return InMetres(
        meaning.MetOnGuardedWay(*events.reached, putdown.to.X_WorldPart, -Vector3::UnitZ()));
  }
  if (condition == "neighbour clear") return InMetres(meaning.NeighbourClear(*events.reached));
  if (condition != "footprint" || events.end == nullptr) return std::nullopt;
  return InMetres(meaning.Footprint(*events.end));
}

std::optional<GeometricMeaning> OfMating(const std::string& condition,
                                         const domain::Problem& problem, const Meaning& meaning,
                                         const StepEvents& events) {
  if (condition == "seat") {
    if (events.reached == nullptr) return std::nullopt;
    const exec::Moment& reached = *events.reached;
    const Pose& X_WorldFixed = reached.parts[meaning.mating().fixed.index()].believed;
    return InMetres(meaning.MetOnGuardedWay(reached, X_WorldFixed * meaning.mating().X_FixedHeld,
                                            meaning.MatingDirection(reached)));
  }
  if (events.poised == nullptr) return std::nullopt;
  if (condition == "tip shift") return meaning.TipError(*events.poised, false);
  if (condition == "tip turn") return meaning.TipError(*events.poised, true);
  const FitMargins margins =
      MarginsOfFits(problem, meaning.mating(), meaning.MatingMotion(*events.poised));
  if (condition == "entry") return InMetres(margins.entry);
  if (condition == "slide-in") return InMetres(margins.slide_in);
  if (condition != "tilt") return std::nullopt;
  return GeometricMeaning{"rad", meaning.TiltLimit() - margins.lean};
}

}  // namespace

std::optional<GeometricMeaning> MeaningOf(const std::string& condition,
                                          const domain::Problem& problem,
                                          const plan::PlannedStep& step, const StepEvents& events) {
  const Meaning meaning(problem, step, events);
  if (condition == "hand clear") return InMetres(meaning.HandClear());
  if (const auto* putdown = std::get_if<plan::Putdown>(&step.action)) {
    return OfLanding(condition, meaning, *putdown, events);
  }
  if (std::holds_alternative<plan::Assemble>(step.action)) {
    return OfMating(condition, problem, meaning, events);
  }
  return OfGrasp(condition, meaning, events);
}

}  // namespace assay::check
