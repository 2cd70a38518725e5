#include "sim/check/trial_verdicts/verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"

namespace assay::check {
namespace {

using domain::MatingId;
using domain::Problem;
using execution::GraspFact;

class Judgement {
 public:
  Judgement(const Problem& problem, const execution::Trace& trace, const Limits& limits)
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
    findings_.push_back(SeatedDepth(problem_, mating, X_FixedHeld, limits_));
    findings_.push_back(LateralError(problem_, mating, X_FixedHeld));
    findings_.push_back(AxisAngle(problem_, mating, X_FixedHeld, limits_));
    for (std::size_t pair = 1; pair < mating.features.size(); ++pair) {
      findings_.push_back(AlignmentError(problem_, mating, pair, X_FixedHeld));
    }
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
    for (const execution::RestRecord* rest : trace_.All<execution::RestRecord>()) {
      Append(AtRest(part, rest->parts[id.index()], limits_));
    }
  }

  GripperState GripperAbout(PartId id) const {
    GripperState state{.opening = end_.opening};
    for (const GraspFact* fact : trace_.All<GraspFact>()) {
      if (fact->part == id) state.held_width = fact->expected_width;
    }
    const std::string body = "part/" + problem_.part(id).name;
    state.touching = std::ranges::any_of(end_.contacts, [&](const auto& pair) {
      return pair.first.starts_with("gripper/") && pair.second == body;
    });
    return state;
  }

  void Append(const std::vector<Finding>& findings) {
    findings_.insert(findings_.end(), findings.begin(), findings.end());
  }

  const Problem& problem_;
  const execution::Trace& trace_;
  const Limits& limits_;
  const execution::Snapshot& end_;
  std::vector<Finding> findings_;
  std::vector<PartId> left_alone_;
};

TrialOutcome TrialOutcomeOf(Aspect aspect) {
  switch (aspect) {
    case Aspect::kSeated:
      return TrialOutcome::kNotSeated;
    case Aspect::kAligned:
      return TrialOutcome::kMisaligned;
    case Aspect::kReleased:
      return TrialOutcome::kNotReleased;
    case Aspect::kAtRest:
      return TrialOutcome::kNotAtRest;
    case Aspect::kLocated:
      return TrialOutcome::kNotLocated;
  }
  ASSAY_CHECK(false, "an aspect that the switch does not know");
  return {};
}

std::string Reason(const Finding& finding) {
  const std::string_view unit = domain::SiUnitOf(finding.dimension).name;
  return fmt::format("{}: {:.4g} {}, limit {:.4g} {}", finding.name, finding.value, unit,
                     finding.limit, unit);
}

std::string Reason(const execution::CollisionRecord& collision) {
  return fmt::format("at {:.2f} s {} touched {}", collision.time, collision.robot, collision.other);
}

std::string Reason(const Problem& problem, const GraspFact& fact) {
  return fmt::format("at {:.2f} s the gripper closed on {} to {:.2f} mm instead of {:.2f} mm{}",
                     fact.time, problem.part(fact.part).name, 1e3 * fact.opening,
                     1e3 * fact.expected_width,
                     fact.pads_touch ? "" : ", and not both pads touched it");
}

}  // namespace

Verdict Judge(const Problem& problem, const execution::Trace& trace, const Limits& limits) {
  Verdict verdict{.findings = Judgement(problem, trace, limits).Findings()};
  const execution::ExecutionEnd& end = trace.end();
  if (end.outcome != TrialOutcome::kSucceeded) {
    verdict.outcome = end.outcome;
    verdict.reason = end.reason;
    return verdict;
  }
  if (const auto collisions = trace.All<execution::CollisionRecord>(); !collisions.empty()) {
    verdict.outcome = TrialOutcome::kCollided;
    verdict.reason = Reason(*collisions.front());
    return verdict;
  }
  const Finding* worst = nullptr;
  for (const Finding& finding : verdict.findings) {
    if (finding.holds) continue;
    if (worst == nullptr || TrialOutcomeOf(finding.aspect) < TrialOutcomeOf(worst->aspect))
      worst = &finding;
  }
  if (worst == nullptr) return verdict;
  verdict.outcome = TrialOutcomeOf(worst->aspect);
  verdict.reason = Reason(*worst);
  for (const GraspFact* fact : trace.All<GraspFact>()) {
    if (fact->holds()) continue;
    return {TrialOutcome::kGraspFailed, Reason(problem, *fact) + "; " + verdict.reason,
            std::move(verdict.findings)};
  }
  return verdict;
}

}  // namespace assay::check
