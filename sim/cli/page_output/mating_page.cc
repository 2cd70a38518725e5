#include "sim/cli/page_output/mating_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/cli/mating_output/fine_motion_report.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/picture_output/contact_graphs.h"
#include "sim/view/page.h"

namespace assay::cli {
namespace {

using finemotion::BelievedPose;
using finemotion::CertainMotion;
using finemotion::PoseChange;

// Returns the greatest displacement that errors leave in each component: metres, then radians.
PoseChange HalfWidths(const BelievedPose& believed) {
  return believed.errors.cwiseAbs().rowwise().sum();
}

std::string ErrorsText(const BelievedPose& believed) {
  const PoseChange half = HalfWidths(believed);
  return fmt::format("x ±{:.2f}, y ±{:.2f}, z ±{:.2f} mm; turned ±{:.2f}, ±{:.2f}, ±{:.2f}°",
                     half[0] / kLengthUnit.factor, half[1] / kLengthUnit.factor,
                     half[2] / kLengthUnit.factor, half[3] / kDegree, half[4] / kDegree,
                     half[5] / kDegree);
}

// Returns the poses of the tip at the extremes of each component, in the fixed part's frame.
std::vector<geometry::Pose> Extremes(const BelievedPose& believed) {
  constexpr double kNegligible = 1e-6;
  std::vector<geometry::Pose> poses;
  for (Eigen::Index k = 0; k < believed.errors.rows(); ++k) {
    const auto& row = believed.errors.row(k);
    if (row.cwiseAbs().sum() < kNegligible) continue;
    const PoseChange extreme = believed.errors * row.cwiseSign().transpose();
    poses.push_back(finemotion::Displaced(believed.X_StationaryMoving, extreme));
    poses.push_back(finemotion::Displaced(believed.X_StationaryMoving, -extreme));
  }
  return poses;
}

std::string KeptText(std::span<const finemotion::ContactKey> keys) {
  return keys.empty() ? "none" : fmt::format("{}", fmt::join(NamesOf(keys), ", "));
}

class MotionLister {
 public:
  explicit MotionLister(const ViewedMating& mating)
      : mating_(mating), rows_(MotionsOf(mating.plan)), mated_(Mating()) {
    for (const auto* motion : mating.strategy.result.trace.All<execution::MotionRecord>()) {
      ends_[motion->motion] = motion->time;
    }
  }

  view::Way Take() {
    view::Way way;
    for (std::size_t i = 0; i < mating_.plan.motions.size(); ++i) way.actions.push_back(At(i));
    for (const report::Element& graph : ContactGraphs(mating_.chain, mating_.plan)) {
      way.drawings.push_back(graph.Markup());
    }
    return way;
  }

 private:
  const domain::Mating& Mating() const {
    return mating_.task.planned.problem.mating(mating_.task.assemble.mating);
  }

  view::WalkedAction At(std::size_t i) const {
    const CertainMotion& motion = mating_.plan.motions[i];
    const report::MatingSubject::Motion& row = rows_[i];
    view::WalkedAction action{
        .action = "until " + std::string(motion.command.until ? "contact " : "") + row.ends_with,
        .facts = {{"contacts kept", KeptText(motion.command.kept)},
                  {"contacts at its end", row.contacts.empty() ? "none" : row.contacts},
                  {"errors at its end", ErrorsText(motion.check.after)},
                  {"first unwanted contact", row.unwanted}},
        .drawing = motion.critical_point};
    if (const auto end = ends_.find(static_cast<int>(i)); end != ends_.end()) {
      action.end = end->second;
    }
    action.region = RegionOf(motion.check.after);
    return action;
  }

  view::Region RegionOf(const BelievedPose& believed) const {
    const auto samples = mating_.strategy.result.trace.All<execution::Sample>();
    const geometry::Pose& X_WorldFixed =
        samples.front()->snapshot.parts[mated_.fixed.index()].believed;
    view::Region region{.part = mated_.held, .extremes = {}};
    for (const geometry::Pose& X_FixedTip : Extremes(believed)) {
      region.extremes.push_back(X_WorldFixed * X_FixedTip * mating_.geometry.X_HeldTip.inverse());
    }
    return region;
  }

  const ViewedMating& mating_;
  const std::vector<report::MatingSubject::Motion> rows_;
  const domain::Mating& mated_;
  std::map<int, double> ends_;  // of the last attempt
};

bool IsDone(const MatedTrial& trial) {
  return trial.seated && trial.result.end.outcome == execution::TrialOutcome::kSucceeded;
}

}  // namespace

std::string MatingPage(const ViewedMating& mating) {
  const domain::Problem& problem = mating.task.planned.problem;
  const scene::Scene scene(problem, mating.scene);
  const MatedTrial& trial = mating.strategy;
  const plan::Plan none;
  const std::string outcome = IsDone(trial)  ? "succeeded"
                              : trial.seated ? std::string(Name(trial.result.end.outcome))
                                             : "not seated";
  return view::Page(
      {.problem = problem,
       .plan = none,
       .scene = scene,
       .trace = trial.result.trace,
       .outcome = outcome,
       .reason = trial.result.end.reason,
       .summary = SummaryOf(mating.geometry, mating.plan) + ".",
       .beside = view::Beside{fmt::format("a straight line with the same errors: {}",
                                          IsDone(mating.straight) ? "seated" : "not seated"),
                              scene, mating.straight.result.trace},
       .way = MotionLister(mating).Take(),
       .source = fmt::format("trial {} of the mating in {}, with {:.2f} times the errors",
                             trial.number, mating.task.planned.scenario, trial.scale),
       .plan_file = mating.task.planned.scenario});
}

}  // namespace assay::cli
