#include "sim/noise/possible_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "planner/base/check.h"
#include "planner/base/input_files/input_error.h"

namespace assay::noise {
namespace {

constexpr int kHalvings = 40;  // of the way between two values of an error

// Returns the noise on the way from `from` to `to`, in these channels only. `share` 0 gives `from`.
Noise OnTheWay(const Noise& from, const Noise& to, const std::vector<std::size_t>& channels,
               double share) {
  Noise between = to;
  for (const std::size_t i : channels) {
    between.Set(i, std::lerp(from.values()[i], to.values()[i], share));
  }
  return between;
}

// Bisects the way from `from`, which `is_possible`, to `to`. Returns a possible point next to an
// impossible one.
Noise LastPossible(const Noise& from, const Noise& to, const std::vector<std::size_t>& channels,
                   const std::function<bool(const Noise&)>& is_possible) {
  double possible = 0;
  double impossible = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (possible + impossible) / 2;
    (is_possible(OnTheWay(from, to, channels, middle)) ? possible : impossible) = middle;
  }
  return OnTheWay(from, to, channels, possible);
}

}  // namespace

double HeightAtStart(const domain::Problem& problem, const Noise& noise, PartId part) {
  return noise.TableHeight(domain::CarrierAtStart(problem, part));
}

std::vector<Pose> TruePoses(const domain::Problem& problem, const Noise& noise,
                            std::span<const Pose> X_WorldPart) {
  std::vector<Pose> truly;
  for (std::size_t i = 0; i < X_WorldPart.size(); ++i) {
    const PartId part(i);
    truly.push_back(noise.TruePose(part, X_WorldPart[i]));
    const double raised = HeightAtStart(problem, noise, part) - noise.TableHeight(part);
    truly.back().pretranslate(geometry::Vector3(0, 0, raised));
  }
  return truly;
}

PossibleStart::PossibleStart(const domain::Problem& problem) : problem_(problem), starts_(problem) {
  for (const domain::Part& part : problem.parts) believed_.push_back(part.X_WorldPart);
}

std::optional<domain::PartPair> PossibleStart::FirstOverlap(const Noise& noise) const {
  return starts_.FirstOverlap(TruePoses(problem_, noise, believed_));
}

void PossibleStart::Require(const Noise& noise) const {
  const std::optional<domain::PartPair> overlap = FirstOverlap(noise);
  if (!overlap) return;
  throw InputError(
      {.file = "noise"},
      fmt::format("'{}' and '{}' overlap at the start", problem_.part(overlap->first).name,
                  problem_.part(overlap->second).name),
      "errors with which parts do not overlap");
}

Noise PossibleStart::MovedBack(Noise wanted, const Noise& possible) const {
  ASSAY_CHECK(wanted.values().size() == possible.values().size());
  // A part that is moved back may then overlap another part, so several turns are needed.
  const std::size_t most_turns = problem_.parts.size() * problem_.parts.size();
  for (std::size_t turn = 0; turn < most_turns; ++turn) {
    const std::optional<domain::PartPair> overlap = FirstOverlap(wanted);
    if (!overlap) return wanted;
    wanted = LastPossible(possible, wanted, ChannelsOf(*overlap, wanted),
                          [&](const Noise& noise) { return !Overlap(*overlap, noise); });
  }
  std::vector<std::size_t> all(wanted.values().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return LastPossible(possible, wanted, all,
                      [&](const Noise& noise) { return !FirstOverlap(noise); });
}

bool PossibleStart::Overlap(const domain::PartPair& pair, const Noise& noise) const {
  const std::vector<Pose> truly = TruePoses(problem_, noise, believed_);
  const auto& [a, b] = pair;
  return starts_.Overlap({a, truly[a.index()]}, {b, truly[b.index()]});
}

std::vector<std::size_t> PossibleStart::ChannelsOf(const domain::PartPair& pair,
                                                   const Noise& noise) const {
  const std::array<PartId, 4> parts = {pair.first, pair.second,
                                       domain::CarrierAtStart(problem_, pair.first),
                                       domain::CarrierAtStart(problem_, pair.second)};
  std::vector<std::size_t> channels;
  for (std::size_t i = 0; i < noise.box().size(); ++i) {
    const Channel& channel = noise.box()[i];
    if (!channel.step.IsNone() || channel.part.IsNone()) continue;
    if (std::ranges::find(parts, channel.part) != parts.end()) channels.push_back(i);
  }
  return channels;
}

std::optional<int> DrawUntilPossible(const std::function<bool()>& draw) {
  for (int rejected = 0; rejected < kMostDraws; ++rejected) {
    if (draw()) return rejected;
  }
  return std::nullopt;
}

}  // namespace assay::noise
