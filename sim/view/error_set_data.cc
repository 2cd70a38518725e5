#include "sim/view/error_set_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/check/measurements/step_events.h"
#include "sim/check/trial_verdicts/extreme_poses.h"
#include "sim/view/pose_data.h"

namespace assay::view {
namespace {

using Json = nlohmann::ordered_json;

// An error set of a part, with the times between which the page shows it.
struct ShownSet {
  plan::StepId step;
  const plan::ErrorSet* set;
  bool is_before = false;  // before the step, not after it
  double from = 0;         // seconds
  double to = 0;
  Json extremes = Json::array();
};

Json ComponentsOf(const plan::ErrorSet& set) {
  Json ranges = Json::object();
  for (const plan::ErrorComponent& component : plan::ErrorComponents()) {
    const Interval& range = set.*component.range;
    if (range.low == 0 && range.high == 0) continue;
    ranges[std::string(component.name)] = {range.low, range.high};
  }
  return ranges;
}

class SetCollector {
 public:
  SetCollector(const plan::Plan& plan, const execution::Trace& trace)
      : plan_(plan), end_(trace.end().snapshot.time) {
    for (const check::StepEvents& events : check::EventsByStep(trace)) AddStep(events);
  }

  // A set is shown no longer than until the next set of its part. The set before the first step on
  // a part is shown from the start, because the part rests until then.
  std::vector<ShownSet> Take() {
    for (std::size_t i = 0; i < sets_.size(); ++i) {
      const auto same_part = [&](const ShownSet& other) {
        return other.set->part == sets_[i].set->part;
      };
      const auto next = std::find_if(sets_.begin() + i + 1, sets_.end(), same_part);
      if (next != sets_.end()) sets_[i].to = std::min(sets_[i].to, next->from);
      const bool is_first = std::none_of(sets_.begin(), sets_.begin() + i, same_part);
      if (is_first && sets_[i].is_before) sets_[i].from = 0;
    }
    return std::move(sets_);
  }

 private:
  void AddStep(const check::StepEvents& events) {
    const plan::Certificate& certificate = plan_.step(events.step).certificate;
    if (events.poised != nullptr) {
      const double acted = events.acted != nullptr ? events.acted->time : end_;
      Add(events.step, certificate.before, true, *events.poised, acted);
    }
    if (events.end != nullptr) Add(events.step, certificate.after, false, *events.end, end_);
  }

  void Add(plan::StepId step, const std::vector<plan::ErrorSet>& sets, bool is_before,
           const execution::Snapshot& snapshot, double to) {
    for (const plan::ErrorSet& set : sets) {
      ShownSet shown{step, &set, is_before, snapshot.time, to};
      const Pose X_PartWorld = snapshot.parts[set.part.index()].believed.inverse();
      for (const Pose& extreme : check::ExtremePoses(plan_.step(step).action, set, snapshot)) {
        shown.extremes.push_back(ToJson(X_PartWorld * extreme));
      }
      sets_.push_back(std::move(shown));
    }
  }

  const plan::Plan& plan_;
  const double end_;
  std::vector<ShownSet> sets_;
};

}  // namespace

Json ErrorSetsOf(const plan::Plan& plan, const execution::Trace& trace) {
  Json all = Json::array();
  for (ShownSet& shown : SetCollector(plan, trace).Take()) {
    all.push_back({{"step", plan.step(shown.step).executed},
                   {"when", shown.is_before ? "before" : "after"},
                   {"part", shown.set->part.index()},
                   {"held", shown.set->in_hand},
                   {"from", shown.from},
                   {"to", shown.to},
                   {"ranges", ComponentsOf(*shown.set)},
                   {"extremes", std::move(shown.extremes)}});
  }
  return all;
}

Json RegionsOf(const std::vector<WalkedAction>& actions) {
  Json all = Json::array();
  double from = 0;
  for (const WalkedAction& action : actions) {
    if (!action.end) break;
    if (action.region) {
      Json extremes = Json::array();
      for (const Pose& extreme : action.region->extremes) extremes.push_back(ToJson(extreme));
      all.push_back({{"part", action.region->part.index()},
                     {"fixed", true},
                     {"from", from},
                     {"to", *action.end},
                     {"extremes", std::move(extremes)}});
    }
    from = *action.end;
  }
  return all;
}

}  // namespace assay::view
