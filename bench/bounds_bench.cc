#include <benchmark/benchmark.h>

#include <algorithm>

#include "bench/workloads/transform_chains.h"
#include "planner/algebra/bounds.h"

namespace assay::algebra {
namespace {

using workloads::ErrorBounds;
using workloads::kArmErrors;
using workloads::kWideErrors;

// Both ends, from the expression on: normal form included.
void BoundBothEnds(benchmark::State& state, const Expression& e, const ExpressionPool& pool,
                   const BoundRequest& request = {}) {
  const ConstraintSet box = DeclaredBox(pool);
  Bound inf, sup;
  for (auto _ : state) {
    inf = BoundBelow(e, box, request);
    sup = BoundAbove(e, box, request);
  }
  state.counters["evaluations"] = static_cast<double>(inf.evaluations + sup.evaluations);
  state.counters["width"] = sup.value - inf.value;
  state.counters["gap"] = std::max(inf.gap, sup.gap);
}

void SparPrecondition(benchmark::State& state) {
  ExpressionPool pool;
  const Expression e = workloads::SparPrecondition(pool);
  BoundBothEnds(state, e, pool);
}
BENCHMARK(SparPrecondition);

void PlanarChain(benchmark::State& state, const ErrorBounds& errors,
                 const BoundRequest& request = {}) {
  RandomStream random(1, "planar");
  ExpressionPool pool;
  const int links = static_cast<int>(state.range(0));
  const Expression e = workloads::PlanarChain(links, errors, random, pool);
  BoundBothEnds(state, e, pool, request);
}
BENCHMARK_CAPTURE(PlanarChain, refined, ErrorBounds())->DenseRange(2, 6);
BENCHMARK_CAPTURE(PlanarChain, wide, kWideErrors)->DenseRange(2, 4);
BENCHMARK_CAPTURE(PlanarChain, termwise, ErrorBounds(), BoundRequest{.highest = Rung::kTermwise})
    ->DenseRange(2, 6);

void SpatialChain(benchmark::State& state, const ErrorBounds& errors) {
  RandomStream random(1, "spatial");
  ExpressionPool pool;
  const int links = static_cast<int>(state.range(0));
  const Expression e = workloads::SpatialChain(links, errors, random, pool);
  BoundBothEnds(state, e, pool);
}
BENCHMARK_CAPTURE(SpatialChain, refined, ErrorBounds())->DenseRange(2, 4);
BENCHMARK_CAPTURE(SpatialChain, arm, kArmErrors)->Arg(2)->Arg(4)->Arg(6);

void CancellingChain(benchmark::State& state) {
  RandomStream random(1, "cancelling");
  ExpressionPool pool;
  const int links = static_cast<int>(state.range(0));
  const Expression e = workloads::CancellingChain(links, ErrorBounds(), random, pool);
  BoundBothEnds(state, e, pool);
}
BENCHMARK(CancellingChain)->DenseRange(1, 3);

}  // namespace
}  // namespace assay::algebra
