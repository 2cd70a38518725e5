#include "sim/execution/trial/scheduler.h"

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace assay::execution {
namespace {

// The number of results for each thread that may wait for an earlier piece that takes longer.
constexpr std::size_t kWaitingPerThread = 8;

}  // namespace

struct Scheduler::Threads {
  explicit Threads(int number)
      : count(static_cast<std::size_t>(number)),
        control(tbb::global_control::max_allowed_parallelism, count),
        arena(number) {}

  std::size_t count;
  tbb::global_control control;  // without it there are no more threads than cores
  tbb::task_arena arena;
};

Scheduler::Scheduler(int threads, std::function<bool()> stop)
    : threads_(std::make_unique<Threads>(threads)), stop_(std::move(stop)) {}

Scheduler::~Scheduler() = default;

bool Scheduler::EndsNow() {
  stopped_ = stopped_ || (stop_ && stop_());
  return stopped_ || error_ != nullptr;
}

bool Scheduler::Ends() {
  const std::lock_guard lock(mutex_);
  return EndsNow();
}

bool Scheduler::Failed() {
  const std::lock_guard lock(mutex_);
  return error_ != nullptr;
}

// Exceptions are kept from TBB, which would cancel the work inside other pieces. They would then
// take partial results for complete ones.
void Scheduler::Run(std::size_t count, Order order, const Piece& piece) {
  std::size_t next = 0;
  const auto begin = [&](tbb::flow_control& control) -> std::size_t {
    if (next < count && !Ends()) return next++;
    control.stop();
    return 0;
  };
  const auto work = [&](std::size_t i) -> KeepResult {
    try {
      return piece(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!EndsNow()) error_ = std::current_exception();
      return {};
    }
  };
  const auto keep = [&](const KeepResult& keep_result) {
    if (!keep_result || Failed()) return;
    try {
      keep_result();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  };
  using tbb::filter_mode;
  const filter_mode kept =
      order == Order::kOfIndices ? filter_mode::serial_in_order : filter_mode::serial_out_of_order;
  threads_->arena.execute([&] {
    tbb::parallel_pipeline(
        kWaitingPerThread * threads_->count,
        tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, begin) &
            tbb::make_filter<std::size_t, KeepResult>(filter_mode::parallel, work) &
            tbb::make_filter<KeepResult, void>(kept, keep));
  });
  if (error_) std::rethrow_exception(error_);
}

}  // namespace assay::execution
