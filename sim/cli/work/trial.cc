#include "sim/cli/work/trial.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "sim/cli/program/interruption.h"
#include "sim/exec/execution/executor.h"

namespace assay::cli {
namespace {

// Hands out the numbers of trials, and keeps the first exception.
class Queue {
 public:
  explicit Queue(int trials) : trials_(trials) {}

  int Next() { return failed_ || Interruption::Requested() ? trials_ + 1 : ++last_; }
  bool Has(int number) const { return number <= trials_; }

  void Fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
    failed_ = true;
  }
  void Rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const int trials_;
  std::atomic<int> last_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr error_;
};

}  // namespace

Trial RunTrial(const Experiment& experiment, int number, Film* film) {
  mujoco::Data data = experiment.scene.Start();
  if (film != nullptr) film->TakeStart(data);
  exec::ExecutorOptions options;
  options.on_timestep = [](const mujoco::Data&) { Interruption::BreakOffIfRequested(); };
  options.observer = film;
  exec::Trace trace =
      exec::Execute(experiment.problem, experiment.plan, experiment.scene, data, options);
  check::Verdict verdict = check::Judge(experiment.problem, trace, {});
  return {number, std::move(trace), std::move(verdict)};
}

void ForEachTrial(int trials, int jobs, const std::function<void(int)>& work) {
  Queue queue(trials);
  const auto work_through = [&](int first) {
    try {
      for (int number = first; queue.Has(number); number = queue.Next()) work(number);
    } catch (const BrokenOff&) {
      // The other threads are interrupted as well.
    } catch (...) {
      queue.Fail(std::current_exception());
    }
  };
  {
    const int first = queue.Next();
    std::vector<std::jthread> threads;
    for (int i = 1; i < std::min(jobs, trials); ++i) {
      threads.emplace_back([&] { work_through(queue.Next()); });
    }
    work_through(first);
  }
  queue.Rethrow();
}

void RunTrials(const Experiment& experiment, const TrialPlan& plan,
               const std::function<void(Trial)>& done) {
  ForEachTrial(plan.trials, plan.jobs, [&](int number) {
    done(RunTrial(experiment, number, number == 1 ? plan.film : nullptr));
  });
}

}  // namespace assay::cli
