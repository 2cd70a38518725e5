#pragma once

#include <string>
#include <vector>

#include "bench/summary/measurements.h"

namespace assay::bench {

// How many times as long a peer takes as we do: of the passes, each with the two times that were
// measured next to each other.
struct Ratio {
  double median = 0;
  double least = 0;
  double greatest = 0;
};

// What a peer took. Of a peer's variants the quickest.
struct PeerTime {
  std::string peer;
  std::string variant;  // if there are several
  Series series;
  Ratio ratio;

  // It had not answered by then: time and ratio are the least that they can be.
  bool TimeWasUp() const;
};

// One piece of work, done by us and by others.
struct Contest {
  std::string instance;
  Series ours;
  std::vector<Series> variants;  // of ours, as by the name after the colon
  std::vector<PeerTime> peers;   // by name

  const PeerTime* Best() const;                                 // null without peers
  const PeerTime* Find(const std::string& peer) const;          // null if it has no time
  const Series* FindVariant(const std::string& variant) const;  // likewise
};

// One that this machine does not have.
struct MissingPeer {
  std::string peer;
  std::string package;  // Debian's, that would bring it
};

// Contests over work of one kind.
struct Family {
  std::string name;
  std::string measured;
  std::string unfair;
  std::string against;  // see Terms (bench/harness/contest.h)
  double at_least = 0;  // 0: nothing is wanted
  double never_below = 0;
  std::vector<MissingPeer> missing;
  std::vector<std::string> wrong;  // answers: "instance/contestant: what was wrong"
  std::vector<Contest> contests;
};

// In the order in which they ran. Benchmarks without "/assay" in their instance are in none.
std::vector<Family> Families(const Measurements& measurements);

// The same with the contests of one kind each, whose name they have: by the name of the instance
// and what our benchmark says of it. Of what there are fewer than three of comes last, as "others".
std::vector<Family> ByKind(const Family& family);

// Of ratios and the like, all positive.
double GeometricMean(const std::vector<double>& values);

// Of all instances that it has a time in. `peer` empty: of the best of each instance.
std::vector<double> Ratios(const Family& family, const std::string& peer);

// The same of a variant of ours.
std::vector<double> VariantRatios(const Family& family, const std::string& variant,
                                  const std::string& peer);

// Those of ours that have a time in some instance, by name.
std::vector<std::string> Variants(const Family& family);

// All that have a time in some instance, by name.
std::vector<std::string> Peers(const Family& family);

}  // namespace assay::bench
