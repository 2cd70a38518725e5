#include "sim/execution/trial/goal_findings.h"

#include <algorithm>
#include <string>
#include <variant>

#include "planner/geometry/pose.h"

namespace assay::execution {
namespace {

using domain::MatingId;
using domain::Problem;

class GoalExamination {
 public:
  GoalExamination(const Problem& problem, const Trace& trace, const Limits& limits)
      : problem_(problem), trace_(trace), limits_(limits), end_(trace.end().snapshot) {}

  std::vector<Finding> Findings() {
    for (const domain::Goal& goal : problem_.goals) {
      std::visit([&](const auto& g) { Examine(g); }, goal);
    }
    return std::move(findings_);
  }

 private:
  void Examine(MatingId id) {
    const domain::Mating& mating = problem_.mating(id);
    const Pose X_FixedHeld =
        end_.parts[mating.fixed.index()].truth.inverse() * end_.parts[mating.held.index()].truth;
    Append(MatingFindings(problem_, mating, X_FixedHeld));
    ExamineLeftAlone(mating.held);
    ExamineLeftAlone(mating.fixed);
  }

  void Examine(const domain::LocatedGoal& goal) {
    const std::size_t part = goal.part.index();
    const Pose above_table =
        geometry::Translation(0, 0, -end_.table_heights[part]) * end_.parts[part].truth;
    Append(Located(problem_.part(goal.part), goal.stable_poses, above_table, limits_));
    ExamineLeftAlone(goal.part);
  }

  // Judges whether the part is released and at rest, once for each part.
  void ExamineLeftAlone(PartId id) {
    if (std::ranges::find(left_alone_, id) != left_alone_.end()) return;
    left_alone_.push_back(id);
    const domain::Part& part = problem_.part(id);
    findings_.push_back(Released(part, GripperAbout(id), limits_));
    for (const RestRecord* rest : trace_.All<RestRecord>()) {
      Append(AtRest(part, rest->parts[id.index()], limits_));
    }
  }

  GripperState GripperAbout(PartId id) const {
    GripperState state{.opening = end_.opening};
    for (const GraspFact* fact : trace_.All<GraspFact>()) {
      if (fact->part == id) state.held_width = fact->expected_width;
    }
    state.touching = std::ranges::any_of(end_.contacts, [&](const auto& pair) {
      return IsOfHand(pair.first, pair.second, id) || IsOfHand(pair.second, pair.first, id);
    });
    return state;
  }

  // If a workcell has several robots, the names of a robot's bodies begin with the name of the
  // robot.
  bool IsOfHand(const std::string& hand, const std::string& body, PartId id) const {
    return hand.find("gripper/") != std::string::npos && body == "part/" + problem_.part(id).name;
  }

  void Append(const std::vector<Finding>& findings) {
    findings_.insert(findings_.end(), findings.begin(), findings.end());
  }

  const Problem& problem_;
  const Trace& trace_;
  const Limits& limits_;
  const Snapshot& end_;
  std::vector<Finding> findings_;
  std::vector<PartId> left_alone_;
};

}  // namespace

std::vector<Finding> GoalFindings(const Problem& problem, const Trace& trace,
                                  const Limits& limits) {
  return GoalExamination(problem, trace, limits).Findings();
}

}  // namespace assay::execution
