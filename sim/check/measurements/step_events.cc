#include "sim/check/measurements/step_events.h"

namespace assay::check {
namespace {

class Sorter {
 public:
  std::vector<StepEvents> Take() { return std::move(steps_); }

  void operator()(const exec::Milestone& milestone) {
    if (steps_.empty() || steps_.back().step != milestone.step) {
      steps_.push_back({.step = milestone.step});
    }
    StepEvents& step = steps_.back();
    const exec::Snapshot*& moment = milestone.stage == exec::Stage::kPoised    ? step.poised
                                    : milestone.stage == exec::Stage::kReached ? step.reached
                                                                               : step.acted;
    // The tool may be poised a second time, to take up other errors.
    if (moment == nullptr || milestone.stage == exec::Stage::kPoised) moment = &milestone.moment;
  }
  void operator()(const exec::GuardRecord& guard) {
    if (!steps_.empty() && !steps_.back().resisted) steps_.back().resisted = guard.resisted;
  }
  void operator()(const exec::LookRecord& look) {
    if (!steps_.empty()) steps_.back().look = &look;
  }
  void operator()(const exec::RecoveryRecord&) { steps_.back().recovered = true; }
  void operator()(const exec::StepEnd& end) { steps_.back().end = &end.moment; }
  void operator()(const exec::ExecutionEnd& end) {
    if (!steps_.empty() && steps_.back().end == nullptr) steps_.back().stopped = &end.moment;
  }
  void operator()(const auto&) {}

 private:
  std::vector<StepEvents> steps_;
};

}  // namespace

std::vector<StepEvents> EventsByStep(const exec::Trace& trace) {
  Sorter sorter;
  for (const exec::TraceEvent& event : trace.events) std::visit(sorter, event);
  return sorter.Take();
}

}  // namespace assay::check
