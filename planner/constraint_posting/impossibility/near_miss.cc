#include "planner/constraint_posting/impossibility/near_miss.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "planner/base/check.h"
#include "planner/constraint_posting/impossibility/constraint_situation.h"
#include "planner/constraint_posting/impossibility/constraint_text.h"
#include "planner/constraint_posting/impossibility/reach_excess.h"
#include "planner/domain/actions/condition.h"
#include "planner/domain/matings/mating_classes.h"

namespace assay::constraint_posting {

using domain::Dimension;
using domain::GraspCondition;
using domain::Limited;
using domain::Mating;
using domain::MatingId;
using domain::Part;
using domain::Problem;
using domain::StablePoseId;
using Kind = Constraint::Kind;

namespace {

std::string Millimetres(double metres) { return fmt::format("{:.4g} mm", 1000 * metres); }
std::string Degrees(double radians) {
  return fmt::format("{:.4g} deg", radians * 180 / std::numbers::pi);
}

std::string PositionText(const Part& part, int position) {
  if (position < domain::InitialLabel(part)) return PoseName(part, StablePoseId(position));
  return "where it starts";
}

// Returns a text such as "peg, 38.1 mm wide between 3 (left side), 4 (right side), approached along
// (0, 0, -1), ..."
std::string HoldText(const RelaxedProblem& relaxed, const HoldOption& hold) {
  const Problem& worked = relaxed.hands()[hold.robot]->problem();
  const Part& part = worked.part(hold.part);
  const domain::Grasp& grasp = (*part.grasps)[hold.grasp];
  std::vector<std::string> faces;
  for (const domain::FeatureNumber number : grasp.hidden) {
    faces.push_back(
        fmt::format("{} ({})", number.index(), part.model->FindFeature(number)->description));
  }
  const geometry::Vector3 approach = grasp.X_PartTool.linear().col(2);
  std::string text = fmt::format(
      "to hold {}, {} wide{}{}, approached along ({:.3g}, {:.3g}, {:.3g})", part.name,
      Millimetres(grasp.width), faces.empty() ? "" : " between ", fmt::join(faces, " and "),
      approach.x() + 0.0, approach.y() + 0.0, approach.z() + 0.0);
  if (hold.mating.IsNone()) return text + ", " + PositionText(part, hold.position);
  const Part& fixed = worked.part(worked.mating(hold.mating).fixed);
  return fmt::format("{}, while it is mated into {}, {}", text, fixed.name,
                     PositionText(fixed, hold.position));
}

std::string ExcessText(GraspCondition condition, const Limited& measured) {
  switch (condition) {
    case GraspCondition::kOpening:
      return fmt::format("the gripper opens {}, and {} more would be needed",
                         Millimetres(measured.limit), Millimetres(measured.excess()));
    case GraspCondition::kPadsFit:
      return fmt::format("the faces have {}, and the pads need {}, which is {} more",
                         Millimetres(measured.limit), Millimetres(measured.value),
                         Millimetres(measured.excess()));
    case GraspCondition::kToolLean:
      return fmt::format("the tool would lean {}, which is {} more than the limit of {}",
                         Degrees(measured.value), Degrees(measured.excess()),
                         Degrees(measured.limit));
    case GraspCondition::kTableClear:
      return fmt::format("hand or fingers would reach {} into the table; at most {} is allowed",
                         Millimetres(measured.value), Millimetres(measured.limit));
    case GraspCondition::kFacesFree:
    case GraspCondition::kReach:
    case GraspCondition::kMateClear:
      break;
  }
  ASSAY_CHECK(false, "a condition that is no matter of more or less");
  return {};
}

std::string ReachText(const plan::Situation& situation) {
  const geometry::Vector3 p = 1e3 * situation.hand->X_WorldTool.translation();
  const std::string where = fmt::format("({:.0f}, {:.0f}, {:.0f}) mm", p.x(), p.y(), p.z());
  if (!situation.excess) {
    return fmt::format("the arm cannot lead the tool to {} on straight ways and back", where);
  }
  return fmt::format(
      "the arm does not reach {} with the tool, {} from its first axis; with this orientation it "
      "reaches {}",
      where, Millimetres(situation.excess->value), Millimetres(situation.excess->limit));
}

// Returns a text about a condition without a measure (domain::Measure).
std::string FailureText(GraspCondition condition, const plan::Situation& situation) {
  switch (condition) {
    case GraspCondition::kReach:
      return ReachText(situation);
    case GraspCondition::kFacesFree:
      return "the part would lie on a face that the pads need";
    case GraspCondition::kMateClear:
      return "hand or fingers would go through the fixed part";
    case GraspCondition::kOpening:
    case GraspCondition::kPadsFit:
    case GraspCondition::kToolLean:
    case GraspCondition::kTableClear:
      break;
  }
  ASSAY_CHECK(false, "a condition that limits a quantity");
  return {};
}

class MissSearch {
 public:
  MissSearch(const RelaxedProblem& relaxed, const std::vector<Constraint>& conflict,
             GraspCondition condition, const Constraint& constraint)
      : relaxed_(relaxed), condition_(condition) {
    std::vector<Constraint> others = relaxed.Constraints();
    std::erase(others, constraint);
    constraints_ = relaxed.IsPossibleWith({others}) ? relaxed.Constraints() : conflict;
    for (const HoldOption& hold : relaxed.Holds()) {
      if ((relaxed.Broken(hold) & static_cast<int>(condition)) == 0) continue;
      const auto measured = relaxed.Measure(condition, hold);
      is_measured_ |= measured.has_value();
      misses_.emplace_back(measured ? measured->excess() : MissingReach(hold), hold);
    }
    std::ranges::stable_sort(misses_, {}, [](const Miss& miss) { return miss.first; });
  }

  std::optional<plan::Reason> Find() const { return is_measured_ ? Measured() : Unmeasured(); }

 private:
  using Miss = std::pair<double, HoldOption>;

  // NearestUnmeasured tests at most this many holds. For each of them it tests whether a plan
  // becomes possible if the condition is waived for this hold alone.
  static constexpr int kMostWaived = 100;

  std::optional<plan::Reason> Measured() const {
    const auto first = std::ranges::partition_point(
        misses_, [&](const Miss& miss) { return !IsEnough(miss.first + domain::kRounding, {}); });
    if (first == misses_.end()) return std::nullopt;
    const HoldOption& hold = NeededOf({first, misses_.end()});
    const Limited limited = *relaxed_.Measure(condition_, hold);
    plan::Situation situation = SituationOf(relaxed_, hold);
    const bool is_angle = condition_ == GraspCondition::kToolLean;
    situation.excess = plan::Excess{is_angle ? Dimension::kAngle : Dimension::kLength,
                                    limited.value, limited.limit};
    return ReasonFor(ExcessText(condition_, limited), hold, std::move(situation));
  }

  std::optional<plan::Excess> ReachExcessOf(const HoldOption& hold) const {
    return ReachExcess(*relaxed_.hands()[hold.robot]->problem().workcell,
                       SituationOf(relaxed_, hold).hand->X_WorldTool);
  }

  // Returns by how much the tool is too far from the arm; 0 for other conditions than kReach.
  double MissingReach(const HoldOption& hold) const {
    if (condition_ != GraspCondition::kReach) return 0;
    const std::optional<plan::Excess> excess = ReachExcessOf(hold);
    return excess ? excess->value - excess->limit : 0;
  }

  std::optional<plan::Reason> Unmeasured() const {
    const std::optional<HoldOption> hold = NearestUnmeasured();
    if (!hold) return std::nullopt;
    plan::Situation situation = SituationOf(relaxed_, *hold);
    if (condition_ == GraspCondition::kReach) situation.excess = ReachExcessOf(*hold);
    return ReasonFor(FailureText(condition_, situation), *hold, situation);
  }

  // Returns a hold that fails by this condition alone: one whose waiver is enough, or else the
  // first.
  std::optional<HoldOption> NearestUnmeasured() const {
    std::optional<HoldOption> first;
    int waived = 0;
    for (const auto& [excess, hold] : misses_) {
      if (relaxed_.Broken(hold) != static_cast<int>(condition_)) continue;
      if (!first) first = hold;
      if (waived++ == kMostWaived) break;
      if (IsEnough(0, hold)) return hold;
    }
    return first;
  }

  plan::Reason ReasonFor(const std::string& failure, const HoldOption& hold,
                         plan::Situation situation) const {
    return {fmt::format("{}: {}", failure, HoldText(relaxed_, hold)), std::move(situation)};
  }

  bool IsEnough(double excess, const std::optional<HoldOption>& also) const {
    return relaxed_.IsPossibleWith(
        {.constraints = constraints_,
         .waiver = Relaxation::Waiver{.condition = condition_, .excess = excess, .also = also}});
  }

  // Returns a hold that fails by the least excess. If several holds fail by this excess, it prefers
  // a hold whose waiver alone is enough.
  const HoldOption& NeededOf(std::span<const Miss> misses) const {
    const double excess = misses.front().first;
    for (const Miss& miss : misses) {
      if (miss.first > excess + domain::kRounding) break;
      if (IsEnough(excess - domain::kRounding, miss.second)) return miss.second;
    }
    return misses.front().second;
  }

  const RelaxedProblem& relaxed_;
  GraspCondition condition_;
  std::vector<Constraint> constraints_;
  std::vector<Miss> misses_;  // sorted by increasing excess
  bool is_measured_ = false;  // whether the condition limits a quantity
};

// The stable poses of the fixed part in which a mating fails by one quantity.
struct FailingPoses {
  std::vector<std::string> texts = {};                     // each with the quantity
  std::optional<std::pair<plan::Excess, int>> least = {};  // the least excess, and its stable pose

  void Add(const Part& fixed, int pose, const plan::Excess& excess, const std::string& quantity) {
    texts.push_back(fmt::format("{} {}", PoseName(fixed, StablePoseId(pose)), quantity));
    if (!least || excess.value < least->first.value) least = {excess, pose};
  }
};

// Returns a reason about the stable poses of the fixed part in which the mating vector is outside
// the friction cone, or in which the held part would end below the table. For each of them, the
// text says by how much. The situation is the one with the least excess.
std::optional<plan::Reason> FrictionConeMiss(const RelaxedProblem& relaxed,
                                             const Constraint& constraint) {
  const Problem& problem = relaxed.problem();
  const Mating& mating = problem.mating(MatingId(constraint.index));
  const Part& fixed = problem.part(mating.fixed);
  const std::vector<domain::StablePose>& poses = fixed.model->stable_poses();
  FailingPoses leaning;
  FailingPoses sunk;
  for (int i = 0; i < static_cast<int>(poses.size()); ++i) {
    const geometry::Pose& X_WorldFixed = poses[static_cast<std::size_t>(i)].X_TablePart;
    const Limited lean = MatingLean(problem, mating, X_WorldFixed);
    const double depth = -HeightOfMated(problem, mating, X_WorldFixed);
    if (lean.excess() > domain::kRounding) {
      leaning.Add(fixed, i, {Dimension::kAngle, lean.value, lean.limit}, Degrees(lean.value));
    } else if (!EndsAboveTable(problem, mating, X_WorldFixed)) {
      sunk.Add(fixed, i, {Dimension::kLength, depth, 0}, Millimetres(depth));
    }
  }
  std::vector<std::string> texts;
  if (sunk.least) {
    texts.push_back(fmt::format("{} would end below the table: {}", problem.part(mating.held).name,
                                fmt::join(sunk.texts, ", ")));
  }
  if (leaning.least) {
    texts.push_back(fmt::format(
        "the mating vector into {} may lean at most {} from straight down, and leans: {}",
        fixed.name, Degrees(leaning.least->first.limit), fmt::join(leaning.texts, ", ")));
  }
  if (texts.empty()) return std::nullopt;
  const auto& [excess, position] = sunk.least ? *sunk.least : *leaning.least;
  plan::Situation situation = MatedAt(relaxed, MatingId(constraint.index), position);
  situation.excess = excess;
  return plan::Reason{fmt::format("{}", fmt::join(texts, "; ")), std::move(situation)};
}

}  // namespace

std::optional<plan::Reason> NearMissOf(const RelaxedProblem& relaxed,
                                       const std::vector<Constraint>& conflict,
                                       const Constraint& constraint) {
  if (constraint.kind == Kind::kFrictionCone) return FrictionConeMiss(relaxed, constraint);
  if (constraint.kind != Kind::kGraspCondition) return std::nullopt;
  const GraspCondition condition = domain::kGraspConditions[constraint.index];
  return MissSearch(relaxed, conflict, condition, constraint).Find();
}

}  // namespace assay::constraint_posting
