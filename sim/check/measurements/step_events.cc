#include "sim/check/measurements/step_events.h"

namespace assay::check {
namespace {

class Sorter {
 public:
  std::vector<StepEvents> Take() { return std::move(steps_); }

  void operator()(const execution::Milestone& milestone) {
    if (steps_.empty() || steps_.back().step != milestone.step) {
      steps_.push_back({.step = milestone.step, .begun = begun_});
    }
    StepEvents& step = steps_.back();
    const execution::Snapshot*& snapshot =
        milestone.stage == execution::Stage::kPoised    ? step.poised
        : milestone.stage == execution::Stage::kReached ? step.reached
                                                        : step.acted;
    // The tool may be poised a second time, to take up other errors.
    if (snapshot == nullptr || milestone.stage == execution::Stage::kPoised)
      snapshot = &milestone.snapshot;
  }
  void operator()(const execution::ExecutionStart& start) { begun_ = &start.snapshot; }
  void operator()(const execution::GuardRecord& guard) {
    if (!steps_.empty() && !steps_.back().resisted) steps_.back().resisted = guard.resisted;
  }
  void operator()(const execution::LookRecord& look) {
    if (!steps_.empty()) steps_.back().look = &look;
  }
  void operator()(const execution::RecoveryRecord&) { steps_.back().recovered = true; }
  void operator()(const execution::StepEnd& end) {
    steps_.back().end = &end.snapshot;
    begun_ = &end.snapshot;
  }
  void operator()(const execution::ExecutionEnd& end) {
    if (!steps_.empty() && steps_.back().end == nullptr) steps_.back().stopped = &end.snapshot;
  }
  void operator()(const auto&) {}

 private:
  std::vector<StepEvents> steps_;
  const execution::Snapshot* begun_ = nullptr;  // where the next step begins
};

}  // namespace

std::vector<StepEvents> EventsByStep(const execution::Trace& trace) {
  Sorter sorter;
  for (const execution::TraceEvent& event : trace.events) std::visit(sorter, event);
  return sorter.Take();
}

}  // namespace assay::check
