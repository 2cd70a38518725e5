#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace benchmark {
class State;
}

namespace assay::bench {

// On what terms the contestants of a family meet; the report says it beside their times.
struct Terms {
  std::string measured = {};  // what the time is of
  std::string unfair = {};    // what makes the comparison unfair, and to whom
  std::string against = {};  // the peer that `at_least` speaks of; empty: the best of each instance
  double at_least = 0;       // wanted: geometric mean of the ratios; 0: nothing is
  double never_below = 0;    // wanted: ratio to the best peer in every instance
};

// The name of our own contestant. Others are "peer" or "peer:variant", of whose variants the best
// counts; "assay:variant" is shown, but compared with nothing.
inline constexpr std::string_view kOurs = "assay";

inline constexpr const char* kTimeout = "timeout";

// A contestant's counter of this prefix and a peer's name: how many times as long that peer took
// where both were measured, by published figures.
inline constexpr const char* kTimesOfPublished = "times:";

inline constexpr double kAsAsked = 0;  // by --benchmark_min_time

// Once for a family, before any of its contestants.
void Announce(std::string_view family, const Terms& terms);

// Registers `work` as the benchmark "family/instance/contestant". Contestants of one instance are
// added one after another, ours first, so that passes over the program time them in turn. `work`
// holds the contestant's answer against ours before its time counts, and skips with an error if
// they differ: an error in any pass is a wrong answer, which the report tells first and `summarize`
// ends with exit code 12 for. Who is not done when the time that it gets is up sets the counter
// kTimeout: what it took until then counts as if it had answered, and is marked. `least_seconds` is
// what it is repeated for in each pass, to be told where most of its time is not measured.
void AddContestant(std::string_view family, std::string_view instance, std::string_view contestant,
                   std::function<void(benchmark::State&)> work, double least_seconds = kAsAsked);

// The same for `work` that tells by itself what one answer took (State::SetIterationTime), once.
void AddTimedContestant(std::string_view family, std::string_view instance,
                        std::string_view contestant, std::function<void(benchmark::State&)> work);

// Instead of a contestant that this machine does not have: the report says so.
void AddMissing(std::string_view family, std::string_view contestant, std::string_view package);

// What random workloads are drawn from: the environment's ASSAY_BENCH_SEED, 1 without it. Ends the
// program if that is no number of 0 .. 2^64 - 1.
std::uint64_t Seed();

// The environment asks for a run that only shows that nothing is broken (ASSAY_BENCH_TINY).
bool Tiny();

}  // namespace assay::bench
