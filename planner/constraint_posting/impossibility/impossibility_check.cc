#include "planner/constraint_posting/impossibility/impossibility_check.h"

#include <algorithm>

#include "planner/constraint_posting/least_actions.h"
#include "planner/domain/actions/condition.h"
#include "planner/domain/matings/mating_classes.h"

namespace assay::constraint_posting {

using domain::GraspId;
using domain::Mating;
using domain::MatingId;
using domain::Part;
using domain::PartId;
using domain::Pose;
using domain::Problem;
using domain::StablePoseId;

namespace {

constexpr StepId kAnyStep = PartialPlan::kFinish;

// Checks that one robot attains nothing outside the set.
class RobotCheck {
 public:
  RobotCheck(const Problem& problem, int robot, const Attainable& attainable)
      : problem_(problem),
        robot_(robot),
        attainable_(attainable),
        reachability_(problem_),
        geometry_(problem_, reachability_) {}

  bool AddsNothing() {
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (attainable_.unfollowed[p]) continue;
      for (int g = 0; g < domain::GraspLabelCount(problem_.parts[p]); ++g) {
        if (Held(PartId(p), g) ? PutsDownAnew(PartId(p), g) : Takes(PartId(p), g)) return false;
      }
    }
    for (std::size_t m = 0; m < problem_.matings.size(); ++m) {
      if (!attainable_.mated[m] && Mates(MatingId(m))) return false;
    }
    return true;
  }

 private:
  bool Held(PartId part, int grasp) const { return attainable_.held[robot_][part.index()][grasp]; }
  bool Rests(PartId part, int position) const { return attainable_.rests[part.index()][position]; }

  // Returns the world of the parts that surely are where they were at the start, without the acting
  // parts.
  World WorldBut(std::initializer_list<PartId> acting) const {
    World world(problem_);
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (attainable_.moved[p]) world.Take(PartId(p));
    }
    for (PartId part : acting) world.Take(part);
    return world;
  }

  bool Takes(PartId id, int grasp) {
    const Part& part = problem_.part(id);
    const int initial = domain::InitialLabel(part);
    if (Rests(id, initial) && TakesFromStart(id, grasp)) return true;
    for (int position = 0; position < initial; ++position) {
      if (Rests(id, position) && IsHeldAtSomePlacement(id, grasp, position)) return true;
    }
    return false;
  }

  bool TakesFromStart(PartId id, int grasp) {
    Blame unused;
    return geometry_.TakingWorks(WorldBut({id}), kAnyStep, id, GraspId(grasp), unused);
  }

  bool PutsDownAnew(PartId id, int grasp) {
    for (int position = 0; position < domain::InitialLabel(problem_.part(id)); ++position) {
      if (!Rests(id, position) && IsHeldAtSomePlacement(id, grasp, position)) return true;
    }
    return false;
  }

  bool IsHeldAtSomePlacement(PartId id, int grasp, int position) {
    if (!IsReachableIn(problem_, id, GraspId(grasp), StablePoseId(position))) return false;
    const World world = WorldBut({id});
    Blame unused;
    return std::ranges::any_of(PosesAt(problem_, id, position), [&](const Pose& X_WorldPart) {
      return geometry_.HasRoom(world, kAnyStep, id, X_WorldPart, unused) &&
             geometry_.HandWorks(world, kAnyStep, id, GraspId(grasp), X_WorldPart, unused);
    });
  }

  bool Mates(MatingId id) {
    const Mating& mating = problem_.mating(id);
    if (attainable_.unfollowed[mating.held.index()]) return true;
    const std::vector<int> grasps = GraspList(problem_, mating);
    return std::ranges::any_of(grasps, [&](int grasp) {
      return Held(mating.held, grasp) && (attainable_.unfollowed[mating.fixed.index()]
                                              ? HandClearsFixed(problem_, id, GraspId(grasp))
                                              : MatesWith(id, grasp));
    });
  }

  bool MatesWith(MatingId id, int grasp) {
    const Mating& mating = problem_.mating(id);
    const Part& fixed = problem_.part(mating.fixed);
    const int initial = domain::InitialLabel(fixed);
    const bool hides = HidesMatingFeatures(problem_, mating, fixed.resting);
    if (Rests(mating.fixed, initial) && !hides && MatesAt(id, grasp, fixed.X_WorldPart)) {
      return true;
    }
    for (int position = 0; position < initial; ++position) {
      const StablePoseId pose(position);
      if (!Rests(mating.fixed, position) || HidesMatingFeatures(problem_, mating, pose) ||
          !IsMateReachableIn(problem_, id, GraspId(grasp), pose)) {
        continue;
      }
      for (const Pose& X_WorldFixed : PosesAt(problem_, mating.fixed, position)) {
        Blame unused;
        if (geometry_.HasRoom(WorldBut({mating.held, mating.fixed}), kAnyStep, mating.fixed,
                              X_WorldFixed, unused) &&
            MatesAt(id, grasp, X_WorldFixed)) {
          return true;
        }
      }
    }
    return false;
  }

  bool MatesAt(MatingId id, int grasp, const Pose& X_WorldFixed) {
    const Mating& mating = problem_.mating(id);
    World world = WorldBut({mating.held, mating.fixed});
    world.Rest(mating.fixed, X_WorldFixed, 0);
    Blame unused;
    return geometry_.MatingWorks(world, kAnyStep, id, GraspId(grasp), unused);
  }

  const Problem& problem_;
  int robot_;
  const Attainable& attainable_;
  domain::KnownReachability reachability_;
  StepGeometry geometry_;
};

// Returns true if the set contains the start and its members are consistent with each other.
bool IsCoherent(const Problem& problem, const Attainable& attainable) {
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    if (!attainable.rests[p][domain::InitialLabel(problem.parts[p])]) return false;
    const bool is_held = std::ranges::any_of(attainable.held, [&](const auto& by_part) {
      return std::ranges::count(by_part[p], true) > 0;
    });
    if (is_held && !attainable.moved[p]) return false;
    if (attainable.unfollowed[p] && !attainable.moved[p]) return false;
    if (problem.parts[p].resting.IsNone() && !attainable.unfollowed[p]) return false;
  }
  for (std::size_t m = 0; m < problem.matings.size(); ++m) {
    const Mating& mating = problem.matings[m];
    const bool is_mated = std::ranges::count(problem.assembled, MatingId(m)) > 0;
    if (is_mated && !attainable.mated[m]) return false;
    if (attainable.mated[m] && !(attainable.unfollowed[mating.held.index()] &&
                                 attainable.unfollowed[mating.fixed.index()])) {
      return false;
    }
  }
  return true;
}

bool MissesAGoal(const Problem& problem, const Attainable& attainable) {
  return std::ranges::any_of(problem.goals, [&](const domain::Goal& goal) {
    if (const auto* mating = std::get_if<MatingId>(&goal)) {
      return !attainable.mated[mating->index()];
    }
    const auto& located = std::get<domain::LocatedGoal>(goal);
    if (attainable.unfollowed[located.part.index()]) return false;
    const std::vector<int> labels = LocatedLabels(problem, located);
    return std::ranges::none_of(
        labels, [&](int label) { return attainable.rests[located.part.index()][label]; });
  });
}

}  // namespace

bool Confirms(const Problem& problem, const Attainable& attainable) {
  if (!IsCoherent(problem, attainable) || !MissesAGoal(problem, attainable)) return false;
  for (int r = 0; r < std::ssize(problem.workcell->robots()); ++r) {
    const Problem worked = WorkedBy(problem, domain::RobotId(r));
    if (!RobotCheck(worked, r, attainable).AddsNothing()) return false;
  }
  return true;
}

}  // namespace assay::constraint_posting
