#pragma once

#include <string>
#include <vector>

#include "bench/summary/measurements.h"

namespace assay::bench {

// The factor by which a peer takes longer than assay, over the passes. Each pass compares the two
// times that were measured next to each other.
struct Ratio {
  double median = 0;
  double least = 0;
  double greatest = 0;
};

// The times of a peer, from the quickest of its variants.
struct PeerTime {
  std::string peer;
  std::string variant;  // empty if the peer has only one variant
  Series series;
  Ratio ratio;

  // Returns whether the peer's time was up before it answered. Its time and its ratio are then
  // lower bounds.
  bool TimeWasUp() const;
};

// One piece of work, done by assay and by peers.
struct Contest {
  std::string instance;
  Series ours;                   // assay's contestant
  std::vector<Series> variants;  // assay's variants, named by the part after the colon
  std::vector<PeerTime> peers;   // ordered by name

  const PeerTime* Best() const;                                 // null if there are no peers
  const PeerTime* Find(const std::string& peer) const;          // null if the peer has no time
  const Series* FindVariant(const std::string& variant) const;  // null if the variant has no time
};

// A peer that this machine does not have.
struct MissingPeer {
  std::string peer;
  std::string package;  // the Debian package that provides it
};

// Contests with work of one kind.
struct Family {
  std::string name;
  std::string measured;
  std::string unfair;
  std::string against;  // see Terms (bench/harness/contest.h)
  double at_least = 0;  // 0 if none is wanted
  double never_below = 0;
  std::vector<MissingPeer> missing;
  std::vector<std::string> wrong;  // wrong answers, as "instance/contestant: what was wrong"
  std::vector<Contest> contests;
};

// Returns the families in the order in which they ran. A benchmark without "/assay" in its instance
// belongs to no family.
std::vector<Family> Families(const Measurements& measurements);

// Returns families of the contests of one kind each, named by the kind. The kind consists of the
// instance's name without its number and of the label of assay's benchmark. Kinds with fewer than
// three contests come last, as "others".
std::vector<Family> ByKind(const Family& family);

// Returns the geometric mean of the values, which must be positive.
double GeometricMean(const std::vector<double>& values);

// Returns the ratios of a peer's time to assay's time, in all instances where the peer has a time.
// With an empty `peer`, it returns the ratios of the best peer of each instance.
std::vector<double> Ratios(const Family& family, const std::string& peer);

// Returns the ratios of the peer's time to the time of a variant of assay, in all instances where
// both have a time. An empty `peer` stands for the best peer of each instance.
std::vector<double> VariantRatios(const Family& family, const std::string& variant,
                                  const std::string& peer);

// Returns assay's variants that have a time in some instance, ordered by name.
std::vector<std::string> Variants(const Family& family);

// Returns the peers that have a time in some instance, ordered by name.
std::vector<std::string> Peers(const Family& family);

}  // namespace assay::bench
