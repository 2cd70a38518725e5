#include "planner/constraint_posting/impossibility/near_miss.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "planner/base/check.h"
#include "planner/constraint_posting/impossibility/constraint_text.h"
#include "planner/domain/actions/condition.h"
#include "planner/domain/matings/mating_classes.h"

namespace assay::constraint_posting {

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

class NearMiss {
 public:
  NearMiss(const RelaxedProblem& relaxed, const std::vector<Constraint>& conflict,
           GraspCondition condition, const Constraint& constraint)
      : relaxed_(relaxed), condition_(condition) {
    std::vector<Constraint> others = relaxed.Constraints();
    std::erase(others, constraint);
    constraints_ = relaxed.IsPossibleWith({others}) ? relaxed.Constraints() : conflict;
    for (const HoldOption& hold : relaxed.Holds()) {
      if ((relaxed.Broken(hold) & static_cast<int>(condition)) == 0) continue;
      const auto measured = relaxed.Measure(condition, hold);
      if (measured) misses_.emplace_back(measured->excess(), hold);
    }
    std::ranges::stable_sort(misses_, {}, [](const Miss& miss) { return miss.first; });
  }

  std::string Text() const {
    const auto first = std::ranges::partition_point(
        misses_, [&](const Miss& miss) { return !IsEnough(miss.first + domain::kRounding, {}); });
    if (first == misses_.end()) return "";
    const HoldOption& hold = NeededOf({first, misses_.end()});
    return fmt::format("{}: {}", ExcessText(condition_, *relaxed_.Measure(condition_, hold)),
                       HoldText(relaxed_, hold));
  }

 private:
  using Miss = std::pair<double, HoldOption>;

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
};

// Returns a text about the stable poses of the fixed part in which the mating vector is outside the
// friction cone. For each of them, the text says how far the mating vector leans.
std::string FrictionConeText(const Problem& problem, MatingId id) {
  const Mating& mating = problem.mating(id);
  const Part& fixed = problem.part(mating.fixed);
  const std::vector<domain::StablePose>& poses = fixed.model->stable_poses();
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Limited lean = MatingLean(problem, mating, poses[i].X_TablePart);
    if (lean.excess() <= domain::kRounding) continue;
    texts.push_back(fmt::format("{} {}", PoseName(fixed, StablePoseId(i)), Degrees(lean.value)));
  }
  if (texts.empty()) return "";
  const Limited any = MatingLean(problem, mating, poses.front().X_TablePart);
  return fmt::format(
      "the mating vector into {} may lean at most {} from straight down, and leans: {}", fixed.name,
      Degrees(any.limit), fmt::join(texts, ", "));
}

}  // namespace

std::vector<std::string> NearMisses(const RelaxedProblem& relaxed,
                                    const std::vector<Constraint>& conflict) {
  std::vector<std::string> texts;
  for (const Constraint& constraint : conflict) {
    std::string text;
    if (constraint.kind == Kind::kGraspCondition) {
      text = NearMiss(relaxed, conflict, domain::kGraspConditions[constraint.index], constraint)
                 .Text();
    } else if (constraint.kind == Kind::kFrictionCone) {
      text = FrictionConeText(relaxed.problem(), MatingId(constraint.index));
    }
    if (!text.empty()) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace assay::constraint_posting
