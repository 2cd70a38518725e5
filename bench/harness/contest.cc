#include "bench/harness/contest.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

namespace assay::bench {

void Announce(std::string_view family, const Terms& terms) {
  const auto tell = [&](std::string_view key, const std::string& text) {
    if (!text.empty()) benchmark::AddCustomContext(fmt::format("{}/{}", family, key), text);
  };
  const auto number = [](double wanted) {
    return wanted > 0 ? fmt::format("{}", wanted) : std::string();
  };
  tell("measured", terms.measured);
  tell("unfair", terms.unfair);
  tell("against", terms.against);
  tell("at_least", number(terms.at_least));
  tell("never_below", number(terms.never_below));
}

namespace {

benchmark::internal::Benchmark* Register(std::string_view family, std::string_view instance,
                                         std::string_view contestant,
                                         std::function<void(benchmark::State&)> work) {
  return benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", family, instance, contestant).c_str(),
                                      std::move(work));
}

}  // namespace

void AddContestant(std::string_view family, std::string_view instance, std::string_view contestant,
                   std::function<void(benchmark::State&)> work, double least_seconds) {
  benchmark::internal::Benchmark* added = Register(family, instance, contestant, std::move(work));
  if (least_seconds != kAsAsked) added->MinTime(least_seconds);
}

void AddTimedContestant(std::string_view family, std::string_view instance,
                        std::string_view contestant, std::function<void(benchmark::State&)> work) {
  Register(family, instance, contestant, std::move(work))->UseManualTime()->Iterations(1);
}

void AddMissing(std::string_view family, std::string_view contestant, std::string_view package) {
  benchmark::AddCustomContext(fmt::format("{}/missing/{}", family, contestant),
                              std::string(package));
}

std::uint64_t Seed() {
  const char* asked = std::getenv("ASSAY_BENCH_SEED");
  if (asked == nullptr) return 1;
  const std::string_view text = asked;
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.begin(), text.end(), seed);
  if (error != std::errc() || end != text.end()) {
    fmt::print(stderr, "ASSAY_BENCH_SEED is \"{}\"; allowed: a whole number of 0 .. 2^64 - 1\n",
               text);
    std::exit(2);
  }
  return seed;
}

bool Tiny() {
  const char* asked = std::getenv("ASSAY_BENCH_TINY");
  return asked != nullptr && *asked != '\0' && std::string_view(asked) != "0";
}

}  // namespace assay::bench
