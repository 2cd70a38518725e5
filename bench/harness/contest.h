#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace benchmark {
class State;
}

namespace assay::bench {

// The terms on which the contestants of a family are compared. The report prints them beside the
// times.
struct Terms {
  std::string measured = {};  // the work whose time is measured
  std::string unfair = {};    // what makes the comparison unfair, and to whom
  // The peer to which `at_least` refers; empty: the best of each instance.
  std::string against = {};
  double at_least = 0;     // wanted geometric mean of the ratios; 0 if none is wanted
  double never_below = 0;  // wanted ratio to the best peer in every instance
};

// The name of assay's own contestant. Others are "peer" or "peer:variant", and only the best of a
// peer's variants counts. "assay:variant" is shown, but not compared.
inline constexpr std::string_view kOurs = "assay";

inline constexpr const char* kTimeout = "timeout";

// The prefix of a counter's name; the rest of the name is a peer. The counter's value is the factor
// by which this peer took longer than the contestant that has the counter. The factor comes from a
// publication that measured both.
inline constexpr const char* kTimesOfPublished = "times:";

inline constexpr double kAsAsked = 0;  // the duration that --benchmark_min_time sets

// Announces a family. It must be called once, before any contestant of the family is added.
void Announce(std::string_view family, const Terms& terms);

// Registers `work` as the benchmark "family/instance/contestant". Contestants of one instance must
// be added one after another, assay first, so that passes over the program time them in turn.
// `work` must compare the contestant's answer with assay's before its time counts, and skip with an
// error if they differ. An error in any pass is a wrong answer: the report shows it first, and
// `summarize` ends with exit code 12. A contestant whose time is up sets the counter kTimeout. Its
// time until then counts as if it had answered, and is marked. `least_seconds` is the time for
// which the work is repeated in each pass. It must be given where most of the work is not timed.
void AddContestant(std::string_view family, std::string_view instance, std::string_view contestant,
                   std::function<void(benchmark::State&)> work, double least_seconds = kAsAsked);

// Registers `work` that runs once and sets the time of its answer itself (State::SetIterationTime).
void AddTimedContestant(std::string_view family, std::string_view instance,
                        std::string_view contestant, std::function<void(benchmark::State&)> work);

// Replaces a contestant that this machine does not have. The report mentions it.
void AddMissing(std::string_view family, std::string_view contestant, std::string_view package);

// Returns the seed of random workloads: the environment's ASSAY_BENCH_SEED, or 1 without it. Ends
// the program if the variable is no number of 0 .. 2^64 - 1.
std::uint64_t Seed();

// Returns whether the environment (ASSAY_BENCH_TINY) wants a short run that only shows that nothing
// is broken.
bool Tiny();

}  // namespace assay::bench
