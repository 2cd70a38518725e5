#include <benchmark/benchmark.h>
#include <glpk.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "bench/harness/contest.h"
#include "bench/workloads/projections.h"
#include "planner/finemotion/forward_projections/meeting.h"

namespace assay::finemotion {
namespace {

using workloads::ProjectionAndContact;
using workloads::ProjectionModel;

enum class Cases {
  kStill,    // a start that does not move, as in the peers' instances
  kMoving,   // a motion whose direction has two errors
  kFewRead,  // a motion, with contact rows that depend on three tolerances, as for two faces
};

constexpr int kCases = 8;       // number of cases for each number of limits
constexpr int kMostLimits = 4;  // greatest number of limits, the paper's

// Returns equal cases for every test with this number of tolerances, with 1 to 4 limits.
std::vector<ProjectionAndContact> MakeCases(Cases kind, int tolerances) {
  RandomStream random(bench::Seed(), "projection");
  ProjectionModel model{.tolerances = tolerances};
  if (kind != Cases::kStill) {
    model.velocity_errors = 2;
    model.time = 1;
  }
  if (kind == Cases::kFewRead) model.tolerances_read = 3;
  std::vector<ProjectionAndContact> cases;
  for (model.limits = 1; model.limits <= kMostLimits; ++model.limits) {
    for (int i = 0; i < kCases; ++i) cases.push_back(workloads::RandomProjection(model, random));
  }
  return cases;
}

// Returns whether a point of the projection satisfies the contact's rows, by a linear program. Its
// variables are the factors of the start's generators, the time s, and s times each factor of the
// velocity's generators.
bool MeetByLinearProgram(const ProjectionAndContact& given) {
  const auto& [projection, contact] = given;
  const int starts = static_cast<int>(projection.start.generators.cols());
  const int motions = static_cast<int>(projection.velocity.generators.cols());
  const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem(glp_create_prob(),
                                                                      &glp_delete_prob);
  glp_prob* const p = problem.get();
  glp_add_cols(p, starts + 1 + motions);
  for (int i = 1; i <= starts; ++i) glp_set_col_bnds(p, i, GLP_DB, -1, 1);
  const double time = projection.time;
  glp_set_col_bnds(p, starts + 1, time > 0 ? GLP_DB : GLP_FX, 0, time);
  for (int i = 1; i <= motions; ++i) {
    glp_set_col_bnds(p, starts + 1 + i, GLP_FR, 0, 0);
    for (const double sign : {-1.0, 1.0}) {
      const int columns[] = {0, starts + 1, starts + 1 + i};
      const double coefficients[] = {0, -1, sign};
      const int row = glp_add_rows(p, 1);
      glp_set_row_bnds(p, row, GLP_UP, 0, 0);
      glp_set_mat_row(p, row, 2, columns, coefficients);
    }
  }
  Eigen::MatrixXd directions(projection.start.center.size(), starts + 1 + motions);
  directions << projection.start.generators, projection.velocity.center,
      projection.velocity.generators;
  std::vector<int> columns(directions.cols() + 1);
  std::iota(columns.begin(), columns.end(), 0);
  Eigen::VectorXd coefficients(directions.cols() + 1);
  const auto add_row = [&](const Eigen::VectorXd& a, double right, int kind) {
    coefficients.tail(directions.cols()) = directions.transpose() * a;
    const int row = glp_add_rows(p, 1);
    const double rest = right - a.dot(projection.start.center);
    glp_set_row_bnds(p, row, kind, rest, rest);
    glp_set_mat_row(p, row, static_cast<int>(directions.cols()), columns.data(),
                    coefficients.data());
  };
  add_row(contact.row, -contact.offset, GLP_FX);
  for (const HalfSpace& limit : contact.limits) add_row(limit.a, limit.b, GLP_UP);
  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  glp_simplex(p, &options);
  return glp_get_status(p) == GLP_OPT;
}

bool MeetByNearestPoint(const ProjectionAndContact& given) {
  return Meet(given.projection, given.contact).meets;
}

bool MeetByEdges(const ProjectionAndContact& given) {
  return MeetAtAnEdge(given.projection, given.contact);
}

using Test = bool (*)(const ProjectionAndContact&);

// Times a round over all cases. The counter `each` is the mean time of one case. Meetings that the
// edge test misses are counted; any other difference from the linear program is an error.
void Time(benchmark::State& state, Test test, Cases kind) {
  const auto cases = MakeCases(kind, static_cast<int>(state.range(0)));
  std::vector<char> found(cases.size());
  for (auto _ : state) std::ranges::transform(cases, found.begin(), test);
  int meetings = 0;
  int missed = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool meets = MeetByLinearProgram(cases[i]);
    meetings += meets ? 1 : 0;
    missed += meets && found[i] == 0 ? 1 : 0;
    if (found[i] != 0 && !meets) state.SkipWithError("found a meeting where there is none");
  }
  if (missed > 0 && test != MeetByEdges) state.SkipWithError("missed a meeting");
  state.counters["each"] = benchmark::Counter(
      static_cast<double>(cases.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["meet"] = meetings;
  state.counters["missed"] = missed;
}

void Tolerances(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("tolerances")
      ->DenseRange(0, 10, 2)
      ->DenseRange(20, 100, 20)
      ->Unit(benchmark::kMicrosecond);
}

// The edge test is exponential in the number of tolerances. It runs once, for as many as the paper
// calls practical.
void FewTolerances(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("tolerances")
      ->DenseRange(0, 10, 2)
      ->Iterations(1)
      ->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(Time, nearest_point_still, MeetByNearestPoint, Cases::kStill)->Apply(Tolerances);
BENCHMARK_CAPTURE(Time, linear_program_still, MeetByLinearProgram, Cases::kStill)
    ->Apply(Tolerances);
BENCHMARK_CAPTURE(Time, edges_still, MeetByEdges, Cases::kStill)->Apply(FewTolerances);
BENCHMARK_CAPTURE(Time, nearest_point_moving, MeetByNearestPoint, Cases::kMoving)
    ->Apply(Tolerances);
BENCHMARK_CAPTURE(Time, linear_program_moving, MeetByLinearProgram, Cases::kMoving)
    ->Apply(Tolerances);
BENCHMARK_CAPTURE(Time, nearest_point_few_read, MeetByNearestPoint, Cases::kFewRead)
    ->Apply(Tolerances);
BENCHMARK_CAPTURE(Time, edges_moving, MeetByEdges, Cases::kMoving)->Apply(FewTolerances);

}  // namespace
}  // namespace assay::finemotion
