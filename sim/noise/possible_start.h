#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/domain/problem/possible_starts.h"
#include "sim/noise/noise.h"

namespace assay::noise {

// Returns the height error of the table under the part at the start. A part that is assembled at
// the start is on the table of the part that carries it.
double HeightAtStart(const domain::Problem& problem, const Noise& noise, PartId part);
// Returns the true poses of all parts at the start, by part. `X_WorldPart` are their poses without
// errors.
std::vector<Pose> TruePoses(const domain::Problem& problem, const Noise& noise,
                            std::span<const Pose> X_WorldPart);

// Separates the noise with which a trial can start from noise with which two parts would overlap.
class PossibleStart {
 public:
  // Keeps a reference to the problem.
  explicit PossibleStart(const domain::Problem& problem);

  // Returns the first two parts that overlap at the start; none if the start is possible.
  std::optional<domain::PartPair> FirstOverlap(const Noise& noise) const;
  // Throws InputError if two parts overlap at the start.
  void Require(const Noise& noise) const;
  // Returns `wanted`, with the start errors of parts that overlap moved back toward those of
  // `possible`, until the parts just do not overlap. The start of `possible` must be possible. Both
  // must have the same box.
  Noise MovedBack(Noise wanted, const Noise& possible) const;

 private:
  bool Overlap(const domain::PartPair& pair, const Noise& noise) const;
  std::vector<std::size_t> ChannelsOf(const domain::PartPair& pair, const Noise& noise) const;

  const domain::Problem& problem_;
  domain::PossibleStarts starts_;
  std::vector<Pose> believed_;
};

inline constexpr int kMostDraws = 1000;
// Calls `draw` until it returns true, which says that the drawn values are possible. Calls it at
// most kMostDraws times. Returns the number of rejected draws; none if all were rejected.
std::optional<int> DrawUntilPossible(const std::function<bool()>& draw);

}  // namespace assay::noise
