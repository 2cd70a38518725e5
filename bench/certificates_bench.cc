#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "bench/pick_and_place.h"
#include "planner/uncertainty/certify.h"

namespace assay {
namespace {

constexpr double kLean = std::numbers::pi / 6;

struct Counts {
  std::int64_t preconditions = 0;
  std::int64_t unproved = 0;
  std::size_t variables = 0;  // of all preconditions of a step, at most
};

// All preconditions of all actions, with texts and worst corners, as plan.json has them.
Counts CertifyAll(const bench::PickAndPlace& work) {
  uncertainty::UncertainWorld world(work.problem, uncertainty::Propagation::kSound);
  Counts counts;
  for (const plan::Action& action : work.actions) {
    const auto step = uncertainty::CertifyStep(world, action, {});
    counts.preconditions += std::ssize(step.certificate.preconditions);
    counts.unproved += std::ssize(step.unproved);
    counts.variables = std::max(counts.variables, step.certificate.variables.size());
  }
  return counts;
}

// Only whether they are proved, as phase two asks.
void DecideAll(const bench::PickAndPlace& work) {
  uncertainty::UncertainWorld world(work.problem, uncertainty::Propagation::kSound);
  for (const plan::Action& action : work.actions) {
    benchmark::DoNotOptimize(
        uncertainty::DecideStep(world, action, {}, uncertainty::Wanted::kAllUnproved));
  }
}

void Certify(benchmark::State& state, double lean) {
  const auto work = bench::MakePickAndPlace(static_cast<int>(state.range(0)), lean);
  Counts counts;
  for (auto _ : state) counts = CertifyAll(work);
  state.counters["preconditions"] = static_cast<double>(counts.preconditions);
  state.counters["unproved"] = static_cast<double>(counts.unproved);
  state.counters["variables"] = static_cast<double>(counts.variables);
  state.SetComplexityN(state.range(0));
}

void Decide(benchmark::State& state, double lean) {
  const auto work = bench::MakePickAndPlace(static_cast<int>(state.range(0)), lean);
  for (auto _ : state) DecideAll(work);
  state.SetComplexityN(state.range(0));
}

double SecondsToCertify(int n, Counts& counts) {
  const auto work = bench::MakePickAndPlace(n, kLean);
  const auto begin = std::chrono::steady_clock::now();
  counts = CertifyAll(work);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// n / preconditions / variables / seconds, once each, and the exponent of the growth from 10 to 50.
void Table(benchmark::State& state) {
  for (auto _ : state) {
    fmt::print("{:>4} {:>14} {:>10} {:>9}\n", "n", "preconditions", "variables", "seconds");
    double at_10 = 0, at_50 = 0;
    for (const int n : {1, 2, 5, 10, 20, 30, 40, 50}) {
      Counts counts;
      const double seconds = SecondsToCertify(n, counts);
      fmt::print("{:>4} {:>14} {:>10} {:>9.4f}\n", n, counts.preconditions, counts.variables,
                 seconds);
      if (n == 10) at_10 = seconds;
      if (n == 50) at_50 = seconds;
    }
    const double exponent = std::log(at_50 / at_10) / std::log(5);
    fmt::print("exponent from n = 10 to 50: {:.2f}\n", exponent);
    state.counters["exponent"] = exponent;
  }
}

BENCHMARK(Table)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(Certify, straight_down, 0.0)
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->DenseRange(10, 50, 10)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK_CAPTURE(Certify, leaning, kLean)
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->DenseRange(10, 50, 10)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK_CAPTURE(Decide, leaning, kLean)
    ->DenseRange(10, 50, 10)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

}  // namespace
}  // namespace assay
