#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/pose.h"

namespace assay::oracle {

// Decides by trying everything whether a plan exists. All states of a small problem are visited,
// with every order, robot, grasp and place. Each step is tested among the parts as they then lie.
// The oracle allows more than the planner does. Every robot acts, all robots may hold a part at the
// same time, and parts are mated with parts that are mated themselves. It does not carry mated
// parts together. It can be trusted if parts start in stable poses.
class ExhaustiveAssembly {
 public:
  enum class Answer {
    kPlan,
    kNone,
    kNoneWithoutCarrying  // parts were mated on the way, and carrying them together might help
  };

  explicit ExhaustiveAssembly(const domain::Problem& problem) {
    for (std::size_t r = 0; r < problem.workcell->robots().size(); ++r) {
      robots_.push_back(WorkedBy(problem, domain::RobotId(r)));
    }
    for (const domain::Part& part : problem.parts) {
      poses_.push_back({{part.resting, part.X_WorldPart}});
      const auto& stable_poses = part.model->stable_poses();
      for (std::size_t s = 0; s < stable_poses.size(); ++s) {
        for (const domain::Placement& placement : problem.workcell->placements()) {
          poses_.back().push_back(
              {domain::StablePoseId(s), placement.X_WorldTable() * stable_poses[s].X_TablePart});
        }
      }
      rests_.push_back(static_cast<int>(poses_.back().size()));
    }
  }

  Answer Run() {
    State start;
    start.parts.resize(poses_.size());
    for (domain::MatingId mating : problem().assembled) {
      start.mated.insert(mating.index());
      parts_mated_ = true;
    }
    Reach(start);
    while (!is_found_ && !open_.empty()) {
      const State state = open_.back();
      open_.pop_back();
      Expand(state);
    }
    if (is_found_) return Answer::kPlan;
    return parts_mated_ ? Answer::kNoneWithoutCarrying : Answer::kNone;
  }

  std::size_t states() const { return known_.size(); }

 private:
  using Pose = geometry::Pose;

  struct Resting {
    domain::StablePoseId pose;  // None if mated onto another part
    Pose X_WorldPart;
  };
  struct Whereabouts {
    int robot = -1;  // negative: no robot holds the part
    int grasp = -1;
    int pose = 0;  // index in poses_, for a part that no robot holds

    auto operator<=>(const Whereabouts&) const = default;
  };
  struct State {
    std::vector<Whereabouts> parts;
    std::set<int> mated;

    auto operator<=>(const State&) const = default;
  };

  const domain::Problem& problem() const { return robots_.front(); }

  bool IsMated(const State& state, int part) const {
    return std::ranges::any_of(state.mated, [&](int m) {
      const domain::Mating& mating = problem().matings[m];
      return mating.held.index() == part || mating.fixed.index() == part;
    });
  }

  bool Meets(const State& state, const domain::Goal& goal) const {
    if (const auto* mating = std::get_if<domain::MatingId>(&goal)) {
      return state.mated.contains(mating->index());
    }
    const auto& located = std::get<domain::LocatedGoal>(goal);
    const Whereabouts& at = state.parts[located.part.index()];
    return at.robot < 0 &&
           std::ranges::count(located.stable_poses, poses_[located.part.index()][at.pose].pose) > 0;
  }

  void Reach(const State& state) {
    if (!known_.insert(state).second) return;
    open_.push_back(state);
    is_found_ = is_found_ || std::ranges::all_of(problem().goals, [&](const domain::Goal& goal) {
                  return Meets(state, goal);
                });
  }

  void Expand(const State& state) {
    for (int r = 0; r < static_cast<int>(robots_.size()); ++r) {
      const auto in_hand = std::ranges::find(state.parts, r, &Whereabouts::robot);
      if (in_hand == state.parts.end()) {
        for (int p = 0; p < static_cast<int>(state.parts.size()); ++p) Take(state, r, p);
        continue;
      }
      const int part = static_cast<int>(in_hand - state.parts.begin());
      PutDown(state, r, part, in_hand->grasp);
      for (int m = 0; m < static_cast<int>(problem().matings.size()); ++m) {
        if (problem().matings[m].held.index() == part) Mate(state, r, m, in_hand->grasp);
      }
    }
  }

  void Take(const State& state, int robot, int part) {
    if (state.parts[part].robot >= 0 || IsMated(state, part)) return;
    const int grasps = static_cast<int>(robots_[robot].parts[part].grasps->size());
    for (int g = 0; g < grasps; ++g) {
      if (!IsReachable(robot, part, g, state.parts[part].pose)) continue;
      if (!IsHandFree(state, robot, part, g, state.parts[part].pose)) continue;
      State next = state;
      next.parts[part] = {.robot = robot, .grasp = g};
      Reach(next);
    }
  }

  void PutDown(const State& state, int robot, int part, int grasp) {
    for (int pose = 1; pose < rests_[part]; ++pose) {
      if (!IsReachable(robot, part, grasp, pose)) continue;
      if (!HasRoom(state, part, pose) || !IsHandFree(state, robot, part, grasp, pose)) continue;
      State next = state;
      next.parts[part] = {.pose = pose};
      Reach(next);
    }
  }

  void Mate(const State& state, int robot, int m, int grasp) {
    const domain::Problem& worked = robots_[robot];
    const domain::Mating& mating = worked.matings[m];
    const int held = mating.held.index();
    const int fixed = mating.fixed.index();
    const Whereabouts& at = state.parts[fixed];
    if (state.mated.contains(m) || at.robot >= 0) return;
    if (!LeavesMatingFeaturesFree(worked, mating, domain::GraspId(grasp))) return;
    const Resting& resting = poses_[fixed][at.pose];
    if (!resting.pose.IsNone() && HidesMatingFeatures(worked, mating, resting.pose)) return;
    const Pose& X_WorldFixed = resting.X_WorldPart;
    if (!InFrictionCone(worked, mating, X_WorldFixed) ||
        !IsMateReachable(robot, m, grasp, at.pose)) {
      return;
    }
    const Pose X_WorldHeld = X_WorldFixed * mating.X_FixedHeld;
    const Pose X_WorldStart =
        X_WorldFixed * geometry::Translation(-mating.mating_vector) * mating.X_FixedHeld;
    for (int other = 0; other < static_cast<int>(state.parts.size()); ++other) {
      if (other == held || other == fixed || state.parts[other].robot >= 0) continue;
      const std::array<domain::PlacedPart, 1> placed = {
          {{domain::PartId(other), X_WorldPart(state, other)}}};
      for (const Pose& X : {X_WorldHeld, X_WorldStart}) {
        if (!Obstacle(worked, {mating.held, X}, placed).IsNone()) return;
        if (!IsFree(worked, held, grasp, X, placed)) return;
      }
    }
    State next = state;
    next.parts[held] = {.pose = PoseOf(held, X_WorldHeld)};
    next.mated.insert(m);
    parts_mated_ = parts_mated_ || next.mated.size() < problem().goals.size();
    Reach(next);
  }

  int PoseOf(int part, const Pose& X_WorldPart) {
    auto& poses = poses_[part];
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (poses[i].pose.IsNone() && poses[i].X_WorldPart.matrix() == X_WorldPart.matrix()) {
        return static_cast<int>(i);
      }
    }
    poses.push_back({domain::StablePoseId::None(), X_WorldPart});
    return static_cast<int>(poses.size()) - 1;
  }

  const Pose& X_WorldPart(const State& state, int part) const {
    return poses_[part][state.parts[part].pose].X_WorldPart;
  }

  using Key = std::array<int, 6>;
  template <class Ask>
  bool Known(const Key& key, const Ask& ask) {
    const auto [answer, is_new] = answers_.try_emplace(key);
    if (is_new) answer->second = ask();
    return answer->second;
  }

  bool IsReachable(int robot, int part, int grasp, int pose) {
    return Known({0, robot, part, grasp, pose, 0}, [&] {
      const Pose& X = poses_[part][pose].X_WorldPart;
      return (pose == 0 || OnTable(robots_[robot], domain::PartId(part), X)) &&
             IsReachableAt(robots_[robot], domain::PartId(part), domain::GraspId(grasp), X);
    });
  }

  bool IsMateReachable(int robot, int mating, int grasp, int pose_of_fixed) {
    return Known({1, robot, mating, grasp, pose_of_fixed, 0}, [&] {
      const int fixed = problem().matings[mating].fixed.index();
      return IsMateReachableAt(robots_[robot], domain::MatingId(mating), domain::GraspId(grasp),
                               poses_[fixed][pose_of_fixed].X_WorldPart);
    });
  }

  bool HasRoom(const State& state, int part, int pose) {
    for (int other = 0; other < static_cast<int>(state.parts.size()); ++other) {
      if (other == part || state.parts[other].robot >= 0) continue;
      const bool crowds = Known({2, part, pose, other, state.parts[other].pose, 0}, [&] {
        const std::array<domain::PlacedPart, 1> placed = {
            {{domain::PartId(other), X_WorldPart(state, other)}}};
        return !Crowding(problem(), domain::PartId(part), poses_[part][pose].X_WorldPart, placed)
                    .IsNone();
      });
      if (crowds) return false;
    }
    return true;
  }

  bool IsHandFree(const State& state, int robot, int part, int grasp, int pose) {
    for (int other = 0; other < static_cast<int>(state.parts.size()); ++other) {
      if (other == part || state.parts[other].robot >= 0) continue;
      const int code = part * 1000 + other;
      const bool is_free = Known({3 + robot, code, grasp, pose, state.parts[other].pose, 0}, [&] {
        const std::array<domain::PlacedPart, 1> placed = {
            {{domain::PartId(other), X_WorldPart(state, other)}}};
        return IsFree(robots_[robot], part, grasp, poses_[part][pose].X_WorldPart, placed);
      });
      if (!is_free) return false;
    }
    return true;
  }

  // Returns whether hand and fingers are free when closed, when open, and when open at the end of
  // the retreat.
  static bool IsFree(const domain::Problem& worked, int part, int grasp_label,
                     const Pose& X_WorldPart, std::span<const domain::PlacedPart> others) {
    const domain::Grasp& grasp = (*worked.parts[part].grasps)[grasp_label];
    const double open = worked.workcell->gripper().max_opening();
    const Pose X_WorldTool = X_WorldPart * grasp.X_PartTool;
    const Pose X_WorldRetreated =
        X_WorldTool * geometry::Translation(0, 0, -worked.workcell->rules().approach_distance);
    return Obstacle(worked, X_WorldTool, grasp.width, others).IsNone() &&
           Obstacle(worked, X_WorldTool, open, others).IsNone() &&
           Obstacle(worked, X_WorldRetreated, open, others).IsNone();
  }

  std::vector<domain::Problem> robots_;
  std::vector<std::vector<Resting>> poses_;  // for each part: at the start, placed, and mated
  // For each part, the number of its poses on the table.
  std::vector<int> rests_;
  std::set<State> known_;
  std::vector<State> open_;
  std::map<Key, bool> answers_;
  bool is_found_ = false;
  bool parts_mated_ = false;
};

}  // namespace assay::oracle
