#include "planner/constraint_posting/impossibility/relaxed_problem.h"

#include <algorithm>
#include <map>

#include "planner/constraint_posting/least_actions.h"
#include "planner/domain/actions/condition.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/geometry/pose.h"

namespace assay::constraint_posting {

using domain::GraspCondition;
using domain::GraspConditions;
using domain::GraspId;
using domain::Mating;
using domain::MatingId;
using domain::Part;
using domain::PartId;
using domain::Pose;
using domain::Problem;
using domain::StablePoseId;
using Kind = Constraint::Kind;

namespace {

constexpr double kWiderThanAnyPart = 1e3;  // metres; no part is wider

// Parts of one model share their grasps.
Problem WithMisses(Problem problem) {
  std::map<const domain::PartModel*, std::shared_ptr<const std::vector<domain::Grasp>>> found;
  for (Part& part : problem.parts) {
    auto& grasps = found[part.model.get()];
    if (!grasps) {
      grasps = std::make_shared<const std::vector<domain::Grasp>>(
          ComputeGrasps(*part.model, problem.workcell->gripper(),
                        {.approach_step = problem.workcell->rules().approach_step,
                         .widest = kWiderThanAnyPart,
                         .with_misfits = true}));
    }
    part.grasps = grasps;
  }
  return problem;
}

// Returns the pose without its place on the table and its rotation about the vertical.
Pose PoseAt(const Part& part, int position) {
  return position == domain::InitialLabel(part) ? part.X_WorldPart
                                                : part.model->stable_poses()[position].X_TablePart;
}

// The least fixed point of the relaxed problem's actions.
class FixedPoint {
 public:
  FixedPoint(const RelaxedProblem& relaxed, const Relaxation& relaxation)
      : relaxed_(relaxed), problem_(relaxed.problem()), relaxation_(relaxation) {
    for (std::size_t c = 0; c < domain::kGraspConditions.size(); ++c) {
      if (Keeps(Kind::kGraspCondition, static_cast<int>(c))) continue;
      left_out_ =
          static_cast<GraspConditions>(left_out_ | static_cast<int>(domain::kGraspConditions[c]));
    }
    Start();
    StartWithWhatIsNotFollowed();
    do {
      grown_ = false;
      for (const HoldOption& hold : holds_) Try(hold);
      for (std::size_t m = 0; m < problem_.matings.size(); ++m) {
        if (now_.unfollowed[problem_.matings[m].held.index()]) Mate(MatingId(m));
      }
    } while (grown_);
  }

  Attainable Take() { return std::move(now_); }

  bool Meets(std::size_t goal) const {
    if (const auto* mating = std::get_if<MatingId>(&problem_.goals[goal])) {
      return now_.mated[mating->index()];
    }
    const auto& located = std::get<domain::LocatedGoal>(problem_.goals[goal]);
    const std::vector<int> labels = LocatedLabels(problem_, located);
    return !Keeps(Kind::kLocated, static_cast<int>(goal)) ||
           std::ranges::any_of(labels,
                               [&](int label) { return now_.rests[located.part.index()][label]; });
  }

 private:
  bool Keeps(Kind kind, int index) const {
    return std::ranges::count(relaxation_.constraints, Constraint{kind, index}) > 0;
  }

  void Start() {
    const std::size_t count = problem_.parts.size();
    now_ = {.rests = std::vector<std::vector<bool>>(count),
            .held = std::vector(relaxed_.hands().size(), std::vector<std::vector<bool>>(count)),
            .mated = std::vector<bool>(problem_.matings.size(), false),
            .moved = PartSet(count, false),
            .unfollowed = PartSet(count, false)};
    for (std::size_t p = 0; p < count; ++p) {
      const bool starts = Keeps(Kind::kStart, static_cast<int>(p));
      const int initial = domain::InitialLabel(problem_.parts[p]);
      now_.rests[p].assign(initial + 1, !starts);
      now_.rests[p][initial] = true;
      now_.moved[p] = !Keeps(Kind::kInTheWay, static_cast<int>(p));
      for (std::size_t r = 0; r < relaxed_.hands().size(); ++r) {
        now_.held[r][p].assign(domain::GraspLabelCount(relaxed_.hands()[r]->problem().parts[p]),
                               false);
      }
    }
    holds_ = relaxed_.Holds();
  }

  void StartWithWhatIsNotFollowed() {
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      const bool has_grasps =
          std::ranges::any_of(now_.held, [&](const auto& by_part) { return !by_part[p].empty(); });
      const bool is_held_anyway = !has_grasps && !Keeps(Kind::kGrasps, static_cast<int>(p));
      if (is_held_anyway || problem_.parts[p].resting.IsNone()) Unfollow(PartId(p));
    }
    for (MatingId mating : problem_.assembled) Mate(mating);
  }

  void Set(std::vector<bool>::reference fact) {
    if (fact) return;
    fact = true;
    grown_ = true;
  }

  void Unfollow(PartId id) {
    const std::size_t p = id.index();
    if (now_.unfollowed[p]) return;
    Set(now_.unfollowed[p]);
    Set(now_.moved[p]);
    now_.rests[p].assign(now_.rests[p].size(), true);
    for (auto& held : now_.held) held[p].assign(held[p].size(), true);
  }

  void Mate(MatingId id) {
    Set(now_.mated[id.index()]);
    Unfollow(problem_.mating(id).held);
    Unfollow(problem_.mating(id).fixed);
  }

  void Try(const HoldOption& hold) {
    if (relaxation_.robot && hold.robot != *relaxation_.robot) return;
    if (!hold.mating.IsNone()) {
      if (!now_.mated[hold.mating.index()] && CanMate(hold)) Mate(hold.mating);
      return;
    }
    const std::size_t p = hold.part.index();
    auto held = now_.held[hold.robot][p][hold.grasp];
    auto rests = now_.rests[p][hold.position];
    if (held == rests || !CanHold(hold)) return;
    if (rests) {
      Set(held);
      Set(now_.moved[p]);
    } else if (hold.position != domain::InitialLabel(problem_.part(hold.part))) {
      Set(rests);
    }
  }

  enum class Standing {
    kFails,
    kHolds,    // some conditions are left out or waived, and all others hold
    kHoldsAll  // all conditions hold
  };
  Standing StandingOf(const HoldOption& hold, int asked) const {
    const int broken = relaxed_.Broken(hold) & asked;
    if (broken == 0) return Standing::kHoldsAll;
    const int left = broken & ~left_out_;
    return left == 0 || IsWaived(hold, left) ? Standing::kHolds : Standing::kFails;
  }

  bool IsWaived(const HoldOption& hold, int broken) const {
    if (!relaxation_.waiver || broken != static_cast<int>(relaxation_.waiver->condition)) {
      return false;
    }
    if (relaxation_.waiver->also == hold) return true;
    const auto measured = relaxed_.Measure(relaxation_.waiver->condition, hold);
    return measured && measured->excess() < relaxation_.waiver->excess;
  }

  bool CanHold(const HoldOption& hold) const {
    const Standing standing = StandingOf(hold, ~0);
    if (standing != Standing::kHoldsAll) return standing == Standing::kHolds;
    return relaxed_.hands()[hold.robot]->IsFree(hold.part, hold.grasp, hold.position, now_.moved);
  }

  bool CanMate(const HoldOption& hold) const {
    const Mating& mating = problem_.mating(hold.mating);
    if (!now_.held[hold.robot][mating.held.index()][hold.grasp]) return false;
    const bool off_pads = LeavesMatingFeaturesFree(relaxed_.hands()[hold.robot]->problem(), mating,
                                                   GraspId(hold.grasp));
    if (!off_pads && Keeps(Kind::kFeaturesOffPads, hold.mating.index())) return false;
    if (now_.unfollowed[mating.fixed.index()]) return CanMateSomewhere(hold);
    if (!now_.rests[mating.fixed.index()][hold.position]) return false;
    const Standing place = StandingOfPlace(hold);
    const Standing standing = StandingOf(hold, ~0);
    if (place == Standing::kFails || standing == Standing::kFails) return false;
    if (!off_pads || place == Standing::kHolds || standing == Standing::kHolds) return true;
    return relaxed_.hands()[hold.robot]->IsMatingFree(hold.mating, hold.grasp, hold.position,
                                                      now_.moved);
  }

  // Tests the conditions of a mating on the hand that do not depend on where the fixed part is.
  bool CanMateSomewhere(const HoldOption& hold) const {
    const int asked = GraspCondition::kOpening | GraspCondition::kMateClear;
    return StandingOf(hold, asked | static_cast<int>(GraspCondition::kPadsFit)) != Standing::kFails;
  }

  // Returns whether the fixed part's position allows the mating.
  Standing StandingOfPlace(const HoldOption& hold) const {
    const Mating& mating = problem_.mating(hold.mating);
    const Part& fixed = problem_.part(mating.fixed);
    const StablePoseId pose =
        hold.position == domain::InitialLabel(fixed) ? fixed.resting : StablePoseId(hold.position);
    const bool hides = HidesMatingFeatures(problem_, mating, pose);
    const bool in_cone = InFrictionCone(problem_, mating, PoseAt(fixed, hold.position));
    if (!hides && in_cone) return Standing::kHoldsAll;
    const int m = hold.mating.index();
    return (hides && Keeps(Kind::kFeaturesOffTable, m)) ||
                   (!in_cone && Keeps(Kind::kFrictionCone, m))
               ? Standing::kFails
               : Standing::kHolds;
  }

  const RelaxedProblem& relaxed_;
  const Problem& problem_;
  const Relaxation& relaxation_;
  int left_out_ = 0;  // the grasp conditions that are left out
  Attainable now_;
  bool grown_ = false;
  std::vector<HoldOption> holds_;
};

}  // namespace

RelaxedProblem::RelaxedProblem(const Problem& problem, Grasps grasps) : problem_(problem) {
  for (std::size_t r = 0; r < problem.workcell->robots().size(); ++r) {
    Problem worked = WorkedBy(problem, domain::RobotId(r));
    if (grasps == Grasps::kWithMisses) worked = WithMisses(std::move(worked));
    hands_.push_back(std::make_unique<RelaxedHand>(std::move(worked)));
  }
}

std::vector<Constraint> RelaxedProblem::Constraints() const {
  std::vector<Constraint> constraints;
  const auto add = [&](Kind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) constraints.push_back({kind, static_cast<int>(i)});
  };
  add(Kind::kGraspCondition, domain::kGraspConditions.size());
  add(Kind::kGrasps, problem_.parts.size());
  add(Kind::kInTheWay, problem_.parts.size());
  for (int p = static_cast<int>(problem_.parts.size()) - 1; p >= 0; --p) {
    constraints.push_back({Kind::kStart, p});
  }
  for (int m = 0; m < std::ssize(problem_.matings); ++m) {
    for (Kind kind : {Kind::kFeaturesOffPads, Kind::kFeaturesOffTable, Kind::kFrictionCone}) {
      constraints.push_back({kind, m});
    }
  }
  for (int g = 0; g < std::ssize(problem_.goals); ++g) {
    if (std::holds_alternative<domain::LocatedGoal>(problem_.goals[g])) {
      constraints.push_back({Kind::kLocated, g});
    }
  }
  return constraints;
}

Attainable RelaxedProblem::AttainableWith(const Relaxation& relaxation) const {
  return FixedPoint(*this, relaxation).Take();
}

bool RelaxedProblem::IsPossibleWith(const Relaxation& relaxation) const {
  const FixedPoint reached(*this, relaxation);
  for (std::size_t goal = 0; goal < problem_.goals.size(); ++goal) {
    if (!reached.Meets(goal)) return false;
  }
  return true;
}

GraspConditions RelaxedProblem::Broken(const HoldOption& hold) const {
  const RelaxedHand& hand = *hands_[hold.robot];
  return hold.mating.IsNone() ? hand.Broken(hold.part, hold.grasp, hold.position)
                              : hand.BrokenMating(hold.mating, hold.grasp, hold.position);
}

std::optional<domain::Limited> RelaxedProblem::Measure(GraspCondition condition,
                                                       const HoldOption& hold) const {
  const Problem& worked = hands_[hold.robot]->problem();
  const domain::Grasp& grasp = (*worked.part(hold.part).grasps)[hold.grasp];
  if (hold.mating.IsNone()) {
    const Pose X_WorldPart = PoseAt(worked.part(hold.part), hold.position);
    return domain::Measure(worked, condition, grasp, X_WorldPart * grasp.X_PartTool);
  }
  const Mating& mating = worked.mating(hold.mating);
  const Pose X_WorldFixed = PoseAt(worked.part(mating.fixed), hold.position);
  const Pose X_WorldTool = X_WorldFixed * mating.X_FixedHeld * grasp.X_PartTool;
  const Pose X_WorldStart =
      geometry::Translation(-(X_WorldFixed.linear() * mating.mating_vector)) * X_WorldTool;
  const auto mated = domain::Measure(worked, condition, grasp, X_WorldTool);
  const auto at_start = domain::Measure(worked, condition, grasp, X_WorldStart);
  return !mated || mated->value > at_start->value ? mated : at_start;
}

std::vector<HoldOption> RelaxedProblem::Holds() const {
  std::vector<HoldOption> holds;
  const auto add = [&](int robot, PartId held, PartId placed, MatingId mating) {
    const Problem& worked = hands_[robot]->problem();
    for (int g = 0; g < domain::GraspLabelCount(worked.part(held)); ++g) {
      for (int position = 0; position < domain::PositionLabelCount(worked.part(placed));
           ++position) {
        holds.push_back({robot, held, mating, g, position});
      }
    }
  };
  for (int r = 0; r < std::ssize(hands_); ++r) {
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      add(r, PartId(p), PartId(p), MatingId::None());
    }
    for (std::size_t m = 0; m < problem_.matings.size(); ++m) {
      add(r, problem_.matings[m].held, problem_.matings[m].fixed, MatingId(m));
    }
  }
  return holds;
}

}  // namespace assay::constraint_posting
