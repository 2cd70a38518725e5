#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bench/pick_and_place.h"
#include "planner/uncertainty/preconditions/certify.h"

namespace assay {
namespace {

constexpr double kLean = std::numbers::pi / 6;

struct Counts {
  std::int64_t preconditions = 0;
  std::int64_t unproved = 0;
  std::size_t variables = 0;  // greatest number of variables in all preconditions of a step
};

// Certifies all preconditions of all actions, with the texts and worst corners of plan.json.
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

// Decides only whether the preconditions are proved, as phase two does.
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

struct Measured {
  int n = 0;
  Counts counts;
  double seconds = 0;
};

Measured Measure(int n, double lean) {
  const auto work = bench::MakePickAndPlace(n, lean);
  const auto begin = std::chrono::steady_clock::now();
  const Counts counts = CertifyAll(work);
  const auto end = std::chrono::steady_clock::now();
  return {n, counts, std::chrono::duration<double>(end - begin).count()};
}

// Writes a table and a plot of n, preconditions, variables and seconds, each measured once, and the
// exponent of the growth from 10 to 50.
void Growth(benchmark::State& state, double lean) {
  constexpr double kColumns = 50;
  for (auto _ : state) {
    std::vector<Measured> all;
    for (const int n : {1, 2, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50}) {
      all.push_back(Measure(n, lean));
    }
    const auto at = [&](int n) { return std::ranges::find(all, n, &Measured::n)->seconds; };
    const double longest = std::ranges::max(all, {}, &Measured::seconds).seconds;
    fmt::print("{:>4} {:>14} {:>10} {:>9}\n", "n", "preconditions", "variables", "seconds");
    for (const auto& [n, counts, seconds] : all) {
      const auto bar = static_cast<std::size_t>(kColumns * seconds / longest);
      fmt::print("{:>4} {:>14} {:>10} {:>9.4f} {}\n", n, counts.preconditions, counts.variables,
                 seconds, std::string(bar, '#'));
    }
    state.counters["exponent"] = std::log(at(50) / at(10)) / std::log(5);
  }
}

BENCHMARK_CAPTURE(Growth, straight_down, 0.0)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(Growth, leaning, kLean)->Iterations(1)->Unit(benchmark::kSecond);
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
