#include "sim/view/deciding_place.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string_view>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/narrow_phase.h"
#include "planner/plan/certificates/condition_table.h"

namespace assay::view {
namespace {

namespace condition = plan::condition;
using domain::PartId;
using domain::ShaftFit;
using execution::Snapshot;
using execution::Stage;
using geometry::Pose;
using geometry::Vector3;

bool IsOneOf(plan::Condition kind, std::initializer_list<plan::Condition> kinds) {
  return std::ranges::count(kinds, kind) > 0;
}

// Returns whether a sentence contains a name as a whole word.
bool Contains(std::string_view sentence, std::string_view name) {
  const auto belongs_to_word = [&](std::size_t at) {
    return at < sentence.size() && (std::isalnum(static_cast<unsigned char>(sentence[at])) != 0 ||
                                    sentence[at] == '-' || sentence[at] == '_');
  };
  std::size_t at = sentence.find(name);
  while (at != std::string_view::npos) {
    if (!belongs_to_word(at - 1) && !belongs_to_word(at + name.size())) return true;
    at = sentence.find(name, at + 1);
  }
  return false;
}

// One step of an execution, from when the tool begins to move until the step acts.
class ExecutedStep {
 public:
  ExecutedStep(const Executed& executed, plan::StepId step)
      : problem(executed.problem),
        action(executed.plan.step(step).action),
        handled(plan::HandledPart(problem, action)),
        fixed(plan::FixedPart(problem, action)) {
    double from = 0;
    double to = 0;
    for (const execution::StepEnd* end : executed.trace.All<execution::StepEnd>()) {
      if (end->step == step) break;
      from = end->snapshot.time;
    }
    for (const execution::Milestone* milestone : executed.trace.All<execution::Milestone>()) {
      if (milestone->step == step && milestone->stage == Stage::kReached && to == 0) {
        to = milestone->snapshot.time;
      }
    }
    for (const execution::Sample* sample : executed.trace.All<execution::Sample>()) {
      const double time = sample->snapshot.time;
      if (from <= time && time <= to) samples.push_back(&sample->snapshot);
    }
  }

  std::string BodyOf(PartId part) const { return "part/" + problem.part(part).name; }
  // Returns the name of a body of the gripper.
  std::string BodyOf(const std::string& piece) const {
    return problem.workcell->robot().Prefix() + "gripper/" + piece;
  }

  const domain::Problem& problem;
  const plan::Action& action;
  PartId handled;
  PartId fixed;
  std::vector<const Snapshot*> samples = {};  // none if the tool did not come where it acts
};

const Pose& PoseOf(PartId part, const Snapshot& at) { return at.parts[part.index()].truth; }

// ---- Shafts in holes ---------------------------------------------------------------------------

Pose HoleAt(const ShaftFit& fit, const ExecutedStep& step, const Snapshot& at) {
  return PoseOf(fit.shaft_is_held ? step.fixed : step.handled, at);
}

// Returns the metres by which the shaft's tip is behind the mouth of the hole.
double DepthAt(const ShaftFit& fit, const ExecutedStep& step, const Snapshot& at) {
  const Pose& X_WorldShaft = PoseOf(fit.shaft_is_held ? step.handled : step.fixed, at);
  const Vector3 tip =
      HoleAt(fit, step, at).inverse() * X_WorldShaft * fit.shaft.X_PartFeature.translation();
  const Pose& mouth = fit.hole.X_PartFeature;
  return mouth.linear().col(2).dot(mouth.translation() - tip);
}

// Returns the last sample before the tip is as deep as this for good. The part may have been lower
// beside the hole before.
const Snapshot& WithTipAt(double depth, const ShaftFit& fit, const ExecutedStep& step) {
  const Snapshot* found = step.samples.back();
  for (const Snapshot* sample : step.samples) {
    if (DepthAt(fit, step, *sample) < depth) found = sample;
  }
  return *found;
}

// Returns the outlines of the seated shaft at the hole's mouth and at its own tip, joined by a few
// lines along the walls.
std::vector<Segment> OutlineOf(const ShaftFit& fit, const Pose& X_WorldHole) {
  constexpr std::size_t kLinesAlongWalls = 8;
  const Pose X_WorldTip = X_WorldHole * fit.X_HoleShaft * fit.shaft.X_PartFeature;
  const geometry::Polygon section = domain::CrossSection(fit);
  const auto corner = [&](std::size_t i, double behind) -> Vector3 {
    const auto& p = section[i % section.size()];
    return X_WorldTip * Vector3(p.x(), p.y(), -behind);
  };
  std::vector<Segment> outline;
  const std::size_t every = std::max<std::size_t>(1, section.size() / kLinesAlongWalls);
  for (std::size_t i = 0; i < section.size(); ++i) {
    for (const double behind : {0.0, fit.depth}) {
      outline.emplace_back(corner(i, behind), corner(i + 1, behind));
    }
    if (i % every == 0) outline.emplace_back(corner(i, 0), corner(i, fit.depth));
  }
  return outline;
}

// Returns the fit that a claim is about.
const ShaftFit* FitNamedIn(const std::string& meaning, const std::vector<ShaftFit>& fits) {
  const auto found =
      std::ranges::find_if(fits, [&](const ShaftFit& fit) { return Contains(meaning, fit.name); });
  if (found != fits.end()) return &*found;
  return fits.empty() ? nullptr : &fits.front();
}

std::optional<DecidingPlace> InHole(const plan::CertifiedPrecondition& claim,
                                    const ExecutedStep& step) {
  const std::vector<ShaftFit> fits =
      domain::FitsOf(step.problem, step.problem.mating(step.action.mating));
  const ShaftFit* fit = FitNamedIn(claim.meaning, fits);
  if (fit == nullptr) return std::nullopt;
  const bool is_decided_inside = IsOneOf(claim.condition, {condition::kSlideIn, condition::kTilt});
  const Snapshot& at = WithTipAt(is_decided_inside ? fit->depth / 2 : 0, *fit, step);
  return DecidingPlace{at.time, {}, OutlineOf(*fit, HoleAt(*fit, step, at))};
}

// ---- Bodies that stay apart --------------------------------------------------------------------

// A convex piece of a body.
struct Piece {
  std::string body;
  std::shared_ptr<const geometry::GjkHull> hull;
  Pose X_WorldPiece;
};

std::vector<Piece> PiecesOf(PartId part, const ExecutedStep& step, const Snapshot& at) {
  std::vector<Piece> pieces;
  for (const geometry::ConvexHull& hull : step.problem.part(part).model->pieces()) {
    pieces.push_back({step.BodyOf(part), geometry::MakeGjkHull(hull), PoseOf(part, at)});
  }
  return pieces;
}

std::vector<Piece> PiecesOfHand(const ExecutedStep& step, const Snapshot& at) {
  const kinematics::Gripper& gripper = step.problem.workcell->gripper();
  std::vector<Piece> pieces;
  const auto add = [&](const std::vector<geometry::Box>& boxes, const auto& body_of) {
    for (const geometry::Box& box : boxes) {
      pieces.push_back(
          {step.BodyOf(body_of(box)), geometry::MakeGjkHull(geometry::HullOf(box)), at.tool.truth});
    }
  };
  add(gripper.HandBoxes(), [](const geometry::Box&) { return "hand"; });
  add(gripper.FingerBoxes(std::min(at.opening, gripper.max_opening())),
      [](const geometry::Box& box) {
        return box.X_FrameBox.translation().y() > 0 ? "finger_left" : "finger_right";
      });
  return pieces;
}

// Returns the parts from which a claim keeps the moved bodies apart: those that it names, or all
// parts that the step does not handle.
std::vector<PartId> PartsToAvoid(const std::string& meaning, const ExecutedStep& step) {
  std::vector<PartId> named;
  std::vector<PartId> others;
  for (int p = 0; p < static_cast<int>(step.problem.parts.size()); ++p) {
    const PartId part(p);
    if (part != step.handled) others.push_back(part);
    if (Contains(meaning, step.problem.part(part).name)) named.push_back(part);
  }
  if (named.size() > 1) std::erase(named, step.handled);  // it is what moves
  return named.empty() ? others : named;
}

// Returns the moved bodies. The fingers are left out if they are to touch the part.
std::vector<Piece> MovedPieces(plan::Condition kind, PartId other, const ExecutedStep& step,
                               const Snapshot& at) {
  if (!IsOneOf(kind, {condition::kHandClear, condition::kFingertip})) {
    return PiecesOf(step.handled, step, at);
  }
  std::vector<Piece> hand = PiecesOfHand(step, at);
  if (other == step.handled) {
    std::erase_if(hand, [&](const Piece& piece) { return piece.body != step.BodyOf("hand"); });
  }
  return hand;
}

// The least distance between bodies that was seen, and where.
struct Approach {
  double distance = std::numeric_limits<double>::infinity();  // metres
  std::optional<DecidingPlace> place = {};

  void Regard(const Piece& a, const Piece& b, double time) {
    constexpr double kNearer = 1e-5;  // metres; bodies that come no nearer than this are at rest
    const auto points =
        geometry::NearestPoints(*a.hull, *b.hull, a.X_WorldPiece.inverse() * b.X_WorldPiece);
    if (!points) return;
    const double between = (points->on_b - points->on_a).norm();
    if (between >= distance - kNearer) return;
    distance = between;
    place = {time, {a.body}, {{a.X_WorldPiece * points->on_a, a.X_WorldPiece * points->on_b}}};
  }
};

// Returns the samples before the first shaft comes into its hole.
std::vector<const Snapshot*> SamplesBeforeHoles(const ExecutedStep& step) {
  std::vector<const Snapshot*> samples = step.samples;
  for (const ShaftFit& fit :
       domain::FitsOf(step.problem, step.problem.mating(step.action.mating))) {
    const double end = WithTipAt(0, fit, step).time;
    std::erase_if(samples, [&](const Snapshot* sample) { return sample->time > end; });
  }
  return samples;
}

std::optional<DecidingPlace> NearestApproach(const plan::CertifiedPrecondition& claim,
                                             const ExecutedStep& step) {
  const std::vector<PartId> others = PartsToAvoid(claim.meaning, step);
  const bool ends_at_holes = claim.condition == condition::kPassingClear;
  Approach nearest;
  for (const Snapshot* at : ends_at_holes ? SamplesBeforeHoles(step) : step.samples) {
    for (const PartId other : others) {
      const std::vector<Piece> moved = MovedPieces(claim.condition, other, step, *at);
      for (const Piece& avoided : PiecesOf(other, step, *at)) {
        for (const Piece& piece : moved) nearest.Regard(piece, avoided, at->time);
      }
    }
  }
  return nearest.place;
}

// ---- All other conditions ----------------------------------------------------------------------

// Returns the lowest point of the fingers, and the point of the table below it.
DecidingPlace AboveTheTable(const ExecutedStep& step, const Snapshot& at) {
  DecidingPlace place = {.time = at.time, .bodies = {}};
  Vector3 lowest = Vector3::Constant(std::numeric_limits<double>::infinity());
  const kinematics::Gripper& gripper = step.problem.workcell->gripper();
  for (const geometry::Box& box :
       gripper.FingerBoxes(std::min(at.opening, gripper.max_opening()))) {
    for (const Vector3& corner : geometry::HullOf(box).vertices) {
      const Vector3 p = at.tool.truth * corner;
      if (p.z() < lowest.z()) lowest = p;
    }
  }
  place.bodies = {step.BodyOf("finger_left"), step.BodyOf("finger_right")};
  place.lines = {{lowest, Vector3(lowest.x(), lowest.y(), 0)}};
  return place;
}

DecidingPlace WhereTheStepActs(const plan::CertifiedPrecondition& claim, const ExecutedStep& step) {
  DecidingPlace place = {.time = step.samples.back()->time, .bodies = {}};
  if (claim.condition == condition::kFingertip) return AboveTheTable(step, *step.samples.back());
  const bool is_about_fingers =
      IsOneOf(claim.condition,
              {condition::kBetweenFingers, condition::kFingerClear, condition::kPadContact});
  if (is_about_fingers) {
    const Snapshot& at = *step.samples.back();
    const auto pad = [&](double side) -> Vector3 {
      return at.tool.truth * Vector3(0, side * at.opening / 2, 0);
    };
    place.bodies = {step.BodyOf("finger_left"), step.BodyOf("finger_right")};
    place.lines = {{pad(-1), pad(1)}};
  } else {
    const bool is_about_fixed =
        IsOneOf(claim.condition, {condition::kFixedStands, condition::kFixedStays});
    place.bodies = {step.BodyOf(is_about_fixed ? step.fixed : step.handled)};
  }
  return place;
}

}  // namespace

std::optional<DecidingPlace> PlaceOf(const plan::CertifiedPrecondition& claim, plan::StepId id,
                                     const Executed& executed) {
  const ExecutedStep step(executed, id);
  if (step.samples.empty()) return std::nullopt;
  std::optional<DecidingPlace> place;
  if (IsOneOf(claim.condition, {condition::kEntry, condition::kSlideIn, condition::kTilt,
                                condition::kTipShift, condition::kTipTurn})) {
    place = InHole(claim, step);
  } else if (IsOneOf(claim.condition, {condition::kHandClear, condition::kPassingClear,
                                       condition::kNeighbourClear, condition::kPushedClear}) ||
             (claim.condition == condition::kFingertip && !step.fixed.IsNone())) {
    place = NearestApproach(claim, step);
  }
  return place ? place : WhereTheStepActs(claim, step);
}

}  // namespace assay::view
