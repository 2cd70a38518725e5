#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/harness/contest.h"
#include "bench/workloads/measured_expressions.h"
#include "bench/workloads/transform_chains.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/expression/simplify.h"
#include "planner/numeric/interval_arithmetic.h"
#ifdef ASSAY_PEER_BOOST_INTERVAL
#include "bench/peers/boost_interval.h"
#endif

namespace assay::algebra {
namespace {

constexpr double kGap = 1e-6;
constexpr double kKnownTo = 1e-6;  // precision of the ranges in the table
constexpr double kAtMostMilliseconds = 10;
constexpr int kChains = 30;  // number of chains of each kind

// One question: SUP and INF of an expression over the declared box.
struct Question {
  Expression expanded;
  ConstraintSet box;
  PreparedExpression prepared;
  std::optional<Interval> known = {};  // the known range of the expression
  std::vector<Expression> waves = {};  // expressions that the peer evaluated as well

  Question(const Expression& e, const ExpressionPool& pool)
      : expanded(e), box(DeclaredBox(pool)), prepared(e) {}

  BothBounds Answer() { return prepared.Both(box, {.gap = kGap}); }
};

Interval RangeOf(const BothBounds& bounds) { return {bounds.inf.value, bounds.sup.value}; }

bool IsNear(const Interval& a, const Interval& b) {
  return std::abs(a.low - b.low) <= kKnownTo && std::abs(a.high - b.high) <= kKnownTo;
}

bool IsAttained(const Expression& e, const Bound& bound) {
  std::vector<Interval> point;
  for (const double x : bound.at) point.push_back({x, x});
  const Interval value = Evaluate(e, std::span<const Interval>(point));
  return value.high >= bound.value - bound.gap && value.low <= bound.value + bound.gap;
}

// Returns what is wrong with the answer, or an empty text.
std::string Fault(const Question& question, const BothBounds& answer) {
  if (!(answer.inf.gap <= kGap && answer.sup.gap <= kGap)) return "the gap is too wide";
  for (const Bound& bound : {answer.inf, answer.sup}) {
    if (!IsAttained(question.expanded, bound)) return "a bound is not attained where it says";
  }
  const bool is_right = !question.known || IsNear(RangeOf(answer), *question.known);
  return is_right ? "" : "the range is not the one that is known";
}

// Returns the processor time, the least of several measurements, so that other work of the machine
// does not count.
double MillisecondsOf(Question& question) {
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    benchmark::DoNotOptimize(question.Answer());
    least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// Sets counters that do not depend on the machine, and the time of the slowest question.
void Count(benchmark::State& state, std::deque<Question>& questions) {
  double evaluations = 0, splits = 0, gap = 0, slowest = 0;
  for (Question& question : questions) {
    const BothBounds answer = question.Answer();
    evaluations += static_cast<double>(answer.inf.evaluations + answer.sup.evaluations);
    splits += static_cast<double>(answer.inf.splits + answer.sup.splits);
    gap = std::max({gap, answer.inf.gap, answer.sup.gap});
    slowest = std::max(slowest, MillisecondsOf(question));
  }
  state.counters["evaluations"] = evaluations;
  state.counters["splits"] = splits;
  state.counters["gap"] = gap;
  state.counters["at_most_ms"] = kAtMostMilliseconds;
  if (questions.size() > 1) {
    state.counters["slowest_ms"] = slowest;
  } else {
    state.counters["size"] = static_cast<double>(VariablesOf(questions.front().expanded).size());
  }
}

using Questions = std::shared_ptr<std::deque<Question>>;

void Bounded(benchmark::State& state, const Questions& questions) {
  for (Question& question : *questions) {
    const std::string fault = Fault(question, question.Answer());
    if (!fault.empty()) return state.SkipWithError(fault.c_str());
  }
  for (auto _ : state) {
    for (Question& question : *questions) benchmark::DoNotOptimize(question.Answer());
  }
  Count(state, *questions);
}

// Times an expression that is asked once: it is brought to normal form and bounded.
void FromScratch(benchmark::State& state, const Questions& questions) {
  for (auto _ : state) {
    for (Question& question : *questions) {
      PreparedExpression prepared(question.expanded);
      benchmark::DoNotOptimize(prepared.Both(question.box, {.gap = kGap}));
    }
  }
}

#ifdef ASSAY_PEER_BOOST_INTERVAL
bool Holds(const Interval& range, const BothBounds& answer) {
  return range.low <= answer.inf.value + answer.inf.gap &&
         answer.sup.value - answer.sup.gap <= range.high;
}

void EvaluatedByBoost(benchmark::State& state, const Questions& questions, bool as_measured,
                      peers::BoostInterval::Rounding rounding) {
  std::vector<peers::BoostInterval> evaluations;
  for (Question& question : *questions) {
    const std::span<const Expression> others = question.waves;
    evaluations.emplace_back(question.expanded, others.first(as_measured ? others.size() : 0),
                             question.box, rounding);
    if (!Holds(evaluations.back().Range(), question.Answer())) {
      return state.SkipWithError("Boost.Interval's range does not hold what we attain");
    }
  }
  for (auto _ : state) {
    for (peers::BoostInterval& evaluation : evaluations) {
      benchmark::DoNotOptimize(evaluation.Range());
    }
  }
}
#endif

#ifdef ASSAY_PEER_BOOST_INTERVAL
using Rounding = peers::BoostInterval::Rounding;

void AddBoost(const char* family, const std::string& instance, const Questions& questions) {
  bench::AddContestant(family, instance, "boost_interval", [questions](benchmark::State& state) {
    EvaluatedByBoost(state, questions, false, Rounding::kByDefault);
  });
}

void AddBoostSetOnce(const char* family, const std::string& instance, const Questions& questions) {
  bench::AddContestant(family, instance, "boost_interval_set_once",
                       [questions](benchmark::State& state) {
                         EvaluatedByBoost(state, questions, false, Rounding::kSetOnce);
                       });
}

// `factor_of_ibex` is the factor by which IBEX took longer than Boost.Interval elsewhere.
void AddBoostAsMeasured(const char* family, const std::string& instance, const Questions& questions,
                        double factor_of_ibex) {
  bench::AddContestant(family, instance, "boost_interval:as_measured",
                       [questions, factor_of_ibex](benchmark::State& state) {
                         EvaluatedByBoost(state, questions, true, Rounding::kByDefault);
                         state.counters[std::string(bench::kTimesOfPublished) + "ibex"] =
                             factor_of_ibex;
                       });
}

void AddMissingBoost(const char*) {}
#else
void AddBoost(const char*, const std::string&, const Questions&) {}
void AddBoostSetOnce(const char*, const std::string&, const Questions&) {}
void AddBoostAsMeasured(const char*, const std::string&, const Questions&, double) {}
void AddMissingBoost(const char* family) {
  bench::AddMissing(family, "boost_interval", "libboost-dev");
}
#endif

void AddContest(const char* family, const std::string& instance, const Questions& questions) {
  const auto with = [&](void (*work)(benchmark::State&, const Questions&)) {
    return [work, questions](benchmark::State& state) { work(state, questions); };
  };
  bench::AddContestant(family, instance, "assay", with(Bounded));
  bench::AddContestant(family, instance, "assay:from_scratch", with(FromScratch));
  AddBoost(family, instance, questions);
  AddBoostSetOnce(family, instance, questions);
}

// ---- Expressions whose ranges are known ----

// Compares computing both bounds to within the gap with one evaluation, which only encloses the
// range.
void AddOneEvaluation(const std::vector<std::pair<std::string, Questions>>& expressions) {
  const char* family = "one-evaluation";
  bench::Announce(
      family,
      {.measured = "SUP and INF of the paper's expression, measured as in the section bounds, and "
                   "one evaluation of the expanded expression by Boost.Interval with its default "
                   "policy, which was also used beside IBEX",
       .unfair = "the section bounds has the reasons. An evaluation by Boost.Interval that sets "
                 "the processor's rounding mode only once is quicker than assay",
       .never_below = 1});
  for (const auto& [name, questions] : expressions) {
    bench::AddContestant(family, name, "assay",
                         [questions](benchmark::State& state) { Bounded(state, questions); });
    AddBoost(family, name, questions);
  }
  AddMissingBoost(family);
}

void AddMeasured() {
  std::vector<std::pair<std::string, Questions>> spar;
  static const std::vector<workloads::MeasuredExpression> expressions =
      workloads::LoadMeasuredExpressions(ASSAY_SOURCE_DIR "/bench/workloads/expressions");
  bench::Announce(
      "bounds",
      {.measured = "certified SUP and INF of an expression to a gap of 1e-6, rounding errors "
                   "included. The expression is prepared before the clock runs: for assay it is in "
                   "normal form, for Boost.Interval it is expanded. Boost.Interval evaluates it "
                   "once. The contestant as_measured also computes the sines and cosines of all "
                   "angles, as in the measurement beside IBEX",
       .unfair =
           "the bounds of Boost.Interval's one evaluation are 1.0 to 3.3 times as wide, but "
           "Boost.Interval serves any expression. The contestant set_once sets the processor's "
           "rounding mode once for a whole evaluation. The library's default policy, which was "
           "measured beside IBEX, sets it for every operation. The time in which assay computes "
           "the normal form counts only in from_scratch. IBEX's optimizer reaches the same gap and "
           "serves any problem. It was measured on another machine beside Boost.Interval, and its "
           "times are scaled by those of Boost.Interval. This is possible for these 17 expressions "
           "only, because IBEX bounded no others",
       .against = "ibex (scaled)",
       .at_least = 3000});
  for (const workloads::MeasuredExpression& measured : expressions) {
    if (bench::Tiny() && measured.name != "spar" && measured.name != "cancel-n1") continue;
    auto questions = std::make_shared<std::deque<Question>>();
    questions->emplace_back(measured.expression(), *measured.problem.pool);
    questions->front().known = measured.range;
    questions->front().waves = measured.waves;
    AddContest("bounds", measured.name, questions);
    AddBoostAsMeasured("bounds", measured.name, questions,
                       1e3 * measured.ibex_ms / measured.boost_us);
    if (measured.name.starts_with("spar")) spar.emplace_back(measured.name, questions);
  }
  AddMissingBoost("bounds");
  AddOneEvaluation(spar);
}

// ---- Random chains ----

using Chain = std::function<Expression(int links, RandomStream&, ExpressionPool&)>;

Questions RandomChains(const std::string& kind, int fewest, int most, const Chain& chain) {
  static std::deque<ExpressionPool> pools;
  RandomStream random(bench::Seed(), kind + " benchmark");
  auto questions = std::make_shared<std::deque<Question>>();
  for (int i = 0; i < (bench::Tiny() ? 2 : kChains); ++i) {
    ExpressionPool& pool = pools.emplace_back();
    const int links = fewest + i % (most - fewest + 1);
    questions->emplace_back(chain(links, random, pool), pool);
  }
  return questions;
}

void AddChains() {
  const char* family = "bounds-of-chains";
  bench::Announce(
      family,
      {.measured =
           "bounds as in the section bounds, of 30 random chains of transforms for each kind. The "
           "kinds are planar chains of 2 to 6 links, spatial chains of 2 to 4 links, planar chains "
           "of 2 to 4 links with wide errors (30 degrees), arms of 2 to 6 joints, and chains of 1 "
           "to 3 links whose terms cancel",
       .unfair = "the section bounds has the reasons. Terms that cancel are not expanded for "
                 "Boost.Interval"});
  const auto add = [&](const char* kind, int fewest, int most, const Chain& chain) {
    AddContest(family, kind, RandomChains(kind, fewest, most, chain));
  };
  const auto planar = [](const workloads::ErrorBounds& errors) {
    return [errors](int links, RandomStream& random, ExpressionPool& pool) {
      return Simplify(workloads::PlanarChain(links, errors, random, pool));
    };
  };
  const auto spatial = [](const workloads::ErrorBounds& errors) {
    return [errors](int links, RandomStream& random, ExpressionPool& pool) {
      return Simplify(workloads::SpatialChain(links, errors, random, pool));
    };
  };
  add("planar", 2, 6, planar({}));
  add("spatial", 2, 4, spatial({}));
  add("wide", 2, 4, planar(workloads::kWideErrors));
  add("arm", 2, 6, spatial(workloads::kArmErrors));
  add("cancelling", 1, 3, [](int links, RandomStream& random, ExpressionPool& pool) {
    return workloads::CancellingChain(links, {}, random, pool);
  });
  AddMissingBoost(family);
}

const bool kAdded = [] {
  AddMeasured();
  AddChains();
  return true;
}();

}  // namespace
}  // namespace assay::algebra
