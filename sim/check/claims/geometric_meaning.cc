#include "sim/check/claims/geometric_meaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "planner/domain/mating/shaft_fit.h"
#include "planner/domain/part/resting.h"
#include "planner/plan/data/pushing.h"
#include "sim/check/claims/fit.h"

namespace assay::check {
namespace {

using domain::PartId;
using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// The part that a step handles, and how the hand holds it.
struct Handling {
  PartId part;
  const plan::Hold* hold;
};

// A distance that is infinite has no subject to report.
void AddInMetres(std::string subject, double observed, std::vector<GeometricMeaning>& meanings) {
  if (std::isfinite(observed)) meanings.push_back({std::move(subject), Unit::kMetre, observed});
}

// Adds a clearance between two bodies. If the shapes overlap, their distance is 0 and the depth of
// the overlap is unknown. They then get a fixed negative value.
void AddClearance(std::string subject, double distance, std::vector<GeometricMeaning>& meanings) {
  constexpr double kOverlap = 1e-3;  // metres, of unknown depth
  if (!std::isfinite(distance)) return;
  meanings.push_back({.subject = std::move(subject),
                      .unit = Unit::kMetre,
                      .observed = distance > 0 ? distance : -kOverlap,
                      .is_at_least_the_margin = false});
}

class Meaning {
 public:
  Meaning(const domain::Problem& problem, const plan::PlannedStep& step, const StepEvents& events)
      : problem_(problem),
        step_(step),
        events_(events),
        gripper_(problem.workcell->gripper()),
        handling_({HandledPart(problem, step.action), HoldIn(step.action)}) {}

  // Returns the grasp frame of the true part in the frame of the true tool.
  Pose GraspInTool(const exec::Snapshot& moment) const {
    return moment.tool.truth.inverse() * PartAt(moment) * handling_.hold->X_PartTool;
  }

  std::vector<GeometricMeaning> BetweenFingers(const exec::Snapshot& reached) const {
    const Pose X_ToolGrasp = GraspInTool(reached);
    std::vector<GeometricMeaning> meanings;
    for (const int contact : {1, 2}) {
      const double side = contact == 1 ? kFirstContact : -kFirstContact;
      const double at = (X_ToolGrasp * Vector3(0, side * handling_.hold->width, 0)).y();
      for (const int finger : {1, 2}) {
        const double inward = finger == 1 ? kFirstFinger * at : -kFirstFinger * at;
        AddInMetres(fmt::format("contact {} lies on the inner side of finger {}", contact, finger),
                    reached.opening / 2 - inward, meanings);
      }
    }
    return meanings;
  }

  std::vector<GeometricMeaning> FingerClear(const exec::Snapshot& reached) const {
    const Pose X_GraspTool = GraspInTool(reached).inverse();
    const Vector2& pad = gripper_.pad_half_extents();
    std::vector<GeometricMeaning> meanings;
    for (const int finger : {1, 2}) {
      const double side = finger == 1 ? kFirstFinger : -kFirstFinger;
      double worst = kInfinity;
      for (const double x : {-pad.x(), pad.x()}) {
        for (const double z : {-pad.y(), pad.y()}) {
          const Vector3 corner = X_GraspTool * Vector3(x, side * reached.opening / 2, z);
          worst = std::min(worst, side * corner.y() - handling_.hold->width / 2);
        }
      }
      AddInMetres(fmt::format("finger {} comes down beside the part", finger), worst, meanings);
    }
    return meanings;
  }

  double Fingertip(const exec::Snapshot& reached) const {
    double lowest = kInfinity;
    const double opening = std::clamp(reached.opening, 0.0, gripper_.max_opening());
    for (const geometry::Box& box : gripper_.FingerBoxes(opening)) {
      for (const Vector3& corner : box.Corners()) {
        lowest = std::min(lowest, (reached.tool.truth * corner).z());
      }
    }
    return lowest - reached.table_heights[handling_.part.index()];
  }

  std::vector<GeometricMeaning> PadContact(const exec::Snapshot& acted) const {
    const Vector3 p = GraspInTool(acted).translation();
    const Vector2& pad = gripper_.pad_half_extents();
    const double margin = problem_.workcell->rules().pad_margin;
    std::vector<GeometricMeaning> meanings;
    AddInMetres("the grasped point stays within the pads' width",
                pad.x() - margin - std::abs(p.x()), meanings);
    AddInMetres("the grasped point stays within the pads' height",
                pad.y() - margin - std::abs(p.z()), meanings);
    return meanings;
  }

  // Returns the margin by which the guarded motion met something within the guarded travel of where
  // that was expected; negative if it met nothing. X_WorldExpected and X_WorldEnd are the believed
  // and the true pose of the part at its end. Pads that bear less than the stop force slide down on
  // the part. The motion has then met something where the part stopped.
  double MetOnGuardedWay(const exec::Snapshot& reached, const Pose& X_WorldExpected,
                         const Pose& X_WorldEnd, const Vector3& direction) const {
    const double travel = problem_.workcell->rules().guarded_travel;
    const Vector3 expected = (X_WorldExpected * handling_.hold->X_PartTool).translation();
    const double beyond = direction.dot(reached.tool.believed.translation() - expected);
    if (events_.resisted.value_or(false)) return travel - std::abs(beyond);
    const double missing = direction.dot(X_WorldEnd.translation() - PartAt(reached).translation());
    const bool may_have_slid = !plan::PadsBearResistance(problem_) && missing <= kStandsOn;
    if (events_.poised == nullptr || !may_have_slid) {
      return std::min(0.0, travel - std::abs(beyond)) - travel;
    }
    const exec::Snapshot& poised = *events_.poised;
    const double way = direction.dot(PartAt(reached).translation() - PartAt(poised).translation());
    const double expected_way = direction.dot(expected - poised.tool.believed.translation());
    return travel - std::abs(way - expected_way);
  }

  double Footprint(const exec::Snapshot& end) const {
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

  std::vector<GeometricMeaning> NeighbourClear(const exec::Snapshot& at) const {
    std::vector<GeometricMeaning> meanings;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (PartId(p) == handling_.part) continue;
      const double distance =
          geometry::Distance(problem_.part(handling_.part).model->shape(), PartAt(at),
                             problem_.parts[p].model->shape(), at.parts[p].truth);
      AddClearance(fmt::format("the part stays clear of {}", problem_.parts[p].name), distance,
                   meanings);
    }
    return meanings;
  }

  // Measures the clearance of the hand at the place where it acts, and at the place where it was
  // stopped on its way. The open hand is also measured along the straight line to its work or from
  // it.
  std::vector<GeometricMeaning> HandClear() const {
    std::vector<GeometricMeaning> meanings;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      const PartId part(p);
      double nearest = kInfinity;
      for (const exec::Snapshot* moment : {events_.reached, events_.acted, events_.stopped}) {
        if (moment == nullptr) continue;
        nearest = std::min(nearest,
                           part == handling_.part ? BesidePads(*moment) : FromHand(part, *moment));
      }
      if (events_.reached != nullptr) nearest = std::min(nearest, Opened(part, *events_.reached));
      AddClearance(fmt::format("the hand stays clear of {}", problem_.parts[p].name), nearest,
                   meanings);
    }
    return meanings;
  }
  double FromHand(PartId part, const exec::Snapshot& at) const {
    const double opening = std::clamp(at.opening, 0.0, gripper_.max_opening());
    return geometry::Distance(problem_.workcell->HandShape(opening), at.tool.truth,
                              problem_.part(part).model->shape(), at.parts[part.index()].truth);
  }
  // Returns the least distance of the open hand from the part along the straight line on which the
  // hand comes to its work or leaves it.
  double Opened(PartId part, const exec::Snapshot& at) const {
    const geometry::CollisionShape hand = problem_.workcell->HandShape(gripper_.max_opening());
    double nearest = kInfinity;
    for (int i = 0; i <= kPlaces; ++i) {
      const double back = problem_.workcell->rules().approach_distance * i / kPlaces;
      nearest = std::min(
          nearest,
          geometry::Distance(hand, at.tool.truth * geometry::Translation(0, 0, -back),
                             problem_.part(part).model->shape(), at.parts[part.index()].truth));
    }
    return nearest;
  }
  // Returns the lesser of two distances. The first is the distance of the hand from the part
  // between its pads. The second is the least distance of a finger from boxes of that part; only
  // boxes that stand out of the plane in which the finger's pad should touch are measured.
  double BesidePads(const exec::Snapshot& at) const {
    const double opening = std::clamp(at.opening, 0.0, gripper_.max_opening());
    const std::vector<geometry::Box> fingers = gripper_.FingerBoxes(opening);
    const geometry::CollisionShape& part = problem_.part(handling_.part).model->shape();
    double nearest = geometry::Distance(geometry::CollisionShape(gripper_.HandBoxes()),
                                        at.tool.truth, part, PartAt(at));
    for (const double side : {-1.0, 1.0}) {
      std::vector<geometry::Box> finger;
      std::ranges::copy_if(fingers, std::back_inserter(finger), [&](const geometry::Box& box) {
        return side * box.X_FrameBox.translation().y() > 0;
      });
      nearest = std::min(nearest,
                         geometry::Distance(geometry::CollisionShape(finger), at.tool.truth,
                                            geometry::CollisionShape(BeyondPad(side)), PartAt(at)));
    }
    return nearest;
  }
  std::vector<geometry::Box> BeyondPad(double side) const {
    std::vector<geometry::Box> beyond;
    for (const geometry::Box& box : problem_.part(handling_.part).model->boxes()) {
      double farthest = -kInfinity;
      for (const Vector3& corner : box.Corners()) {
        const Vector3 in_hand = handling_.hold->X_PartTool.inverse() * corner;
        farthest = std::max(farthest, side * in_hand.y());
      }
      if (farthest > handling_.hold->width / 2 + kFlush) beyond.push_back(box);
    }
    return beyond;
  }
  // Measures clearances along the mating motion from where the held part was poised. They are from
  // the fixed part until the shafts come to the mouths of their holes, and from other parts to the
  // end.
  std::vector<GeometricMeaning> PassingClear(const exec::Snapshot& poised) const {
    double depth = 0;
    for (const domain::ShaftFit& fit : domain::FitsOf(problem_, mating())) {
      depth = std::max(depth, fit.depth);
    }
    const Vector3 direction = MatingDirection(poised);
    std::vector<GeometricMeaning> meanings;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (PartId(p) == handling_.part) continue;
      const double length =
          mating().mating_vector.norm() - (PartId(p) == mating().fixed ? depth + kBeforeMouth : 0);
      double nearest = kInfinity;
      for (int i = 0; i <= kPlaces; ++i) {
        const Vector3 way = std::max(0.0, length) * i / kPlaces * direction;
        nearest = std::min(
            nearest, geometry::Distance(problem_.part(handling_.part).model->shape(),
                                        geometry::Translation(way) * PartAt(poised),
                                        problem_.parts[p].model->shape(), poised.parts[p].truth));
      }
      AddClearance(fmt::format("{} passes {} on its way in", problem_.part(handling_.part).name,
                               problem_.parts[p].name),
                   nearest, meanings);
    }
    return meanings;
  }

  const domain::Mating& mating() const { return problem_.mating(step_.action.mating); }
  // Returns the direction in which the held part is believed to move, in the world frame.
  Vector3 MatingDirection(const exec::Snapshot& at) const {
    return (at.parts[mating().fixed.index()].believed.linear() * mating().mating_vector)
        .normalized();
  }
  // Returns the true pose of the held part in the fixed part's frame, and its direction of motion.
  Motion MatingMotion(const exec::Snapshot& poised) const {
    const Pose X_FixedWorld = poised.parts[mating().fixed.index()].truth.inverse();
    return {X_FixedWorld * poised.parts[mating().held.index()].truth,
            X_FixedWorld.linear() * MatingDirection(poised)};
  }
  // Compares the true tip with the believed one at the strategy's start, in the fixed part's frame.
  GeometricMeaning TipError(const exec::Snapshot& poised, bool of_turn) const {
    const plan::Strategy& strategy = *step_.strategy;
    const Pose X_HandTip = handling_.hold->X_PartTool.inverse() * strategy.X_HeldTip;
    const exec::TrueAndBelieved& fixed = poised.parts[mating().fixed.index()];
    const Pose believed = fixed.believed.inverse() * poised.tool.believed * X_HandTip;
    const Pose truth = fixed.truth.inverse() * PartAt(poised) * strategy.X_HeldTip;
    const Eigen::AngleAxisd turn(geometry::Matrix3(truth.linear() * believed.linear().inverse()));
    const Vector3 shift = truth.translation() - believed.translation();
    const plan::StrategyCertificate& absorbed = strategy.certificate;
    if (!of_turn) return {{}, Unit::kMetre, (absorbed.d - shift.cwiseAbs()).minCoeff()};
    return {{}, Unit::kRadian, (absorbed.w - (turn.angle() * turn.axis()).cwiseAbs()).minCoeff()};
  }
  // Shafts that are alike may share a precondition, and the least of its limits then holds for
  // each.
  std::vector<GeometricMeaning> Tilts(const exec::Snapshot& poised) const {
    std::vector<GeometricMeaning> meanings;
    for (const Lean& lean : LeansInSlots(problem_, mating(), MatingMotion(poised))) {
      const std::string subject = lean.slot + " neither touches twice nor wedges";
      meanings.push_back({subject, Unit::kRadian, LeastLimit("tilt", subject) - lean.sine});
    }
    return meanings;
  }
  double LeastLimit(const std::string& condition, const std::string& subject) const {
    double of_all = kInfinity;
    double of_subject = kInfinity;
    for (const plan::CertifiedPrecondition& claim : step_.certificate.preconditions) {
      if (claim.condition != condition) continue;
      of_all = std::min(of_all, std::abs(claim.limit));
      if (claim.meaning == subject) of_subject = std::min(of_subject, std::abs(claim.limit));
    }
    return std::isfinite(of_subject) ? of_subject : of_all;
  }

  // Positions along the tool's y axis, as the grasp numbers contacts and fingers.
  static constexpr double kFirstContact = 0.5;  // of the width
  static constexpr double kFirstFinger = -1;    // of half the opening
  static constexpr double kStandsOn = 1e-3;     // metres above the table
  static constexpr double kFlush = 1e-6;        // metres by which a face may stand out of its plane
  static constexpr double kBeforeMouth = 1e-3;  // metres
  static constexpr int kPlaces = 16;            // points along a straight line

 private:
  const Pose& PartAt(const exec::Snapshot& moment) const {
    return moment.parts[handling_.part.index()].truth;
  }

  const domain::Problem& problem_;
  const plan::PlannedStep& step_;
  const StepEvents& events_;
  const kinematics::Gripper& gripper_;
  Handling handling_;
};

using Meanings = std::vector<GeometricMeaning>;

Meanings InMetres(double observed) {
  Meanings meanings;
  AddInMetres({}, observed, meanings);
  return meanings;
}

// A wrist that yields makes room that is not there before the walls push, so the certified margin
// cannot be expected of the observed value.
Meanings InsideWalls(double observed, const domain::Problem& problem) {
  Meanings meanings = InMetres(observed);
  for (GeometricMeaning& meaning : meanings) {
    meaning.counts_on_yielding = problem.workcell->rules().lateral_compliance > 0;
    meaning.is_at_least_the_margin = !meaning.counts_on_yielding;
  }
  return meanings;
}

Meanings OfGrasp(const std::string& condition, const Meaning& meaning, const StepEvents& events) {
  if (events.reached == nullptr) return {};
  if (condition == "between fingers") return meaning.BetweenFingers(*events.reached);
  if (condition == "finger clear") return meaning.FingerClear(*events.reached);
  if (condition == "fingertip") return InMetres(meaning.Fingertip(*events.reached));
  if (condition != "pad contact" || events.acted == nullptr) return {};
  return meaning.PadContact(*events.acted);
}

Meanings OfLanding(const std::string& condition, const Meaning& meaning,
                   const plan::Action& putdown, const StepEvents& events) {
  if (events.reached == nullptr) return {};
  if (condition == "landing height") {
    const Pose& X_WorldPart = putdown.place.X_WorldPart;
    const double table = events.reached->table_heights[putdown.part.index()];
    return InMetres(meaning.MetOnGuardedWay(*events.reached, X_WorldPart,
                                            geometry::Translation(0, 0, table) * X_WorldPart,
                                            -Vector3::UnitZ()));
  }
  if (condition == "neighbour clear") return meaning.NeighbourClear(*events.reached);
  if (condition != "footprint" || events.end == nullptr) return {};
  return InMetres(meaning.Footprint(*events.end));
}

Meanings OfMating(const std::string& condition, const domain::Problem& problem,
                  const Meaning& meaning, const StepEvents& events) {
  if (condition == "seat") {
    if (events.reached == nullptr) return {};
    const exec::Snapshot& reached = *events.reached;
    const auto& fixed = reached.parts[meaning.mating().fixed.index()];
    const Pose& X_FixedHeld = meaning.mating().X_FixedHeld;
    return InMetres(meaning.MetOnGuardedWay(reached, fixed.believed * X_FixedHeld,
                                            fixed.truth * X_FixedHeld,
                                            meaning.MatingDirection(reached)));
  }
  if (events.poised == nullptr) return {};
  if (condition == "passing clear") return meaning.PassingClear(*events.poised);
  if (condition == "tip shift") return {meaning.TipError(*events.poised, false)};
  if (condition == "tip turn") return {meaning.TipError(*events.poised, true)};
  if (condition == "tilt") return meaning.Tilts(*events.poised);
  const FitMargins margins =
      MarginsOfFits(problem, meaning.mating(), meaning.MatingMotion(*events.poised));
  if (condition == "entry") return InsideWalls(margins.entry, problem);
  if (condition == "slide-in") return InsideWalls(margins.slide_in, problem);
  return {};
}

}  // namespace

std::vector<GeometricMeaning> MeaningsOf(const std::string& condition,
                                         const domain::Problem& problem,
                                         const plan::PlannedStep& step, const StepEvents& events) {
  const Meaning meaning(problem, step, events);
  if (condition == "hand clear") return meaning.HandClear();
  const domain::Leaves leaves = step.action.kind->leaves;
  if (leaves == domain::Leaves::kAtPlace) {
    return OfLanding(condition, meaning, step.action, events);
  }
  if (leaves == domain::Leaves::kMated) {
    return OfMating(condition, problem, meaning, events);
  }
  return OfGrasp(condition, meaning, events);
}

bool IsMeasured(std::string_view condition) {
  constexpr auto kMeasured = std::to_array<std::string_view>(
      {"between fingers", "finger clear", "fingertip", "pad contact", "landing height", "footprint",
       "neighbour clear", "hand clear", "passing clear", "entry", "slide-in", "tilt", "tip shift",
       "tip turn", "seat"});
  return std::ranges::find(kMeasured, condition) != kMeasured.end();
}

}  // namespace assay::check
