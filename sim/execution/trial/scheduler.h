#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace assay::execution {

// Runs numbered pieces of work, such as trials, on several threads (oneTBB). Pieces are begun in
// the order of their indices, the first one on the calling thread, so that an interrupted run has
// made the first ones. Results are kept by one thread at a time, so that keeping them needs no
// lock.
//
// No more pieces are begun after `stop` has returned true, or after a piece of work or keeping its
// result has thrown. Pieces that take long ask Ends, and end by throwing an exception of any type.
// An exception that a piece throws after a stop is dropped, and the piece has no result. The first
// other exception is thrown again when the pieces that were begun have ended, and no later result
// is kept.
class Scheduler {
 public:
  // `stop` is asked before each piece, by one thread at a time; empty: nothing stops the work.
  explicit Scheduler(int threads, std::function<bool()> stop = {});
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  // Runs `count` trials, or other pieces of work: calls work(i) for each i below `count`, and
  // keep(i, result) with the results in the order of the indices. What is kept does not depend on
  // the number of threads.
  template <class Work, class Keep>
  void InOrder(std::size_t count, const Work& work, const Keep& keep) {
    Run(count, Order::kOfIndices, Kept(work, keep));
  }
  // Calls the same functions as the template above, but keeps each result as soon as it is there.
  template <class Work, class Keep>
  void AsDone(std::size_t count, const Work& work, const Keep& keep) {
    Run(count, Order::kOfEnds, Kept(work, keep));
  }

  // Returns whether no more trials, or other pieces of work, are begun. Any thread may call it.
  bool Ends();
  // Returns whether `stop` has stopped the work that was run before.
  bool stopped() const { return stopped_; }

 private:
  enum class Order { kOfIndices, kOfEnds };
  using KeepResult = std::function<void()>;
  // Makes the result of a piece, and returns a function that keeps it.
  using Piece = std::function<KeepResult(std::size_t)>;

  template <class Work, class Keep>
  static Piece Kept(const Work& work, const Keep& keep) {
    return [&work, &keep](std::size_t i) -> KeepResult {
      auto result = std::make_shared<decltype(work(i))>(work(i));
      return [&keep, i, result] { keep(i, std::move(*result)); };
    };
  }
  void Run(std::size_t count, Order order, const Piece& piece);
  bool EndsNow();
  bool Failed();

  struct Threads;
  std::unique_ptr<Threads> threads_;
  std::function<bool()> stop_;
  std::mutex mutex_;  // guards the members below
  bool stopped_ = false;
  std::exception_ptr error_;  // the first one
};

}  // namespace assay::execution
