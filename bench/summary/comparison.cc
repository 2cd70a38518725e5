#include "bench/summary/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "bench/harness/contest.h"

namespace assay::bench {
namespace {

struct ContestName {
  std::string family;
  std::string instance;
  std::string contestant;
};

std::optional<ContestName> Parse(const std::string& name) {
  const std::size_t first = name.find('/');
  const std::size_t last = name.rfind('/');
  if (first == std::string::npos || first == last) return std::nullopt;
  return ContestName{name.substr(0, first), name.substr(first + 1, last - first - 1),
                     name.substr(last + 1)};
}

// Splits "peer:variant".
std::pair<std::string, std::string> PeerAndVariant(const std::string& contestant) {
  const std::size_t colon = contestant.find(':');
  if (colon == std::string::npos) return {contestant, ""};
  return {contestant.substr(0, colon), contestant.substr(colon + 1)};
}

Ratio RatioOf(const Series& peer, const Series& ours) {
  Series ratios;
  const std::size_t passes = std::min(peer.seconds.size(), ours.seconds.size());
  for (std::size_t i = 0; i < passes; ++i) {
    ratios.seconds.push_back(peer.seconds[i] / ours.seconds[i]);
  }
  const auto [least, greatest] = std::ranges::minmax(ratios.seconds);
  return {ratios.Median(), least, greatest};
}

// Sets the peer's time if it has none, or if this variant is quicker than the known one.
void Improve(std::vector<PeerTime>& peers, const std::string& peer, const std::string& variant,
             const Series& series) {
  const auto known = std::ranges::find(peers, peer, &PeerTime::peer);
  if (known == peers.end()) {
    peers.push_back({.peer = peer, .variant = variant, .series = series, .ratio = {}});
  } else if (series.Median() < known->series.Median()) {
    *known = {.peer = peer, .variant = variant, .series = series, .ratio = {}};
  }
}

// Adds peers that are known from published figures alone. A contestant that was measured beside
// such a peer in a publication has a counter with the factor by which the peer took longer.
void ImproveByPublished(std::vector<PeerTime>& peers, const Series& series) {
  const std::string prefix = kTimesOfPublished;
  for (const auto& [counter, multiple] : series.counters) {
    if (!counter.starts_with(prefix)) continue;
    Series scaled = {.name = series.name, .seconds = series.seconds};
    for (double& seconds : scaled.seconds) seconds *= multiple;
    Improve(peers, counter.substr(prefix.size()) + " (scaled)", "", scaled);
  }
}

void Enter(Contest& contest, const std::string& contestant, const Series& series) {
  const auto [peer, variant] = PeerAndVariant(contestant);
  if (contestant == kOurs) {
    contest.ours = series;
  } else if (peer == kOurs) {
    contest.variants.push_back(series);
  } else {
    Improve(contest.peers, peer, variant, series);
    ImproveByPublished(contest.peers, series);
  }
}

class Register {
 public:
  explicit Register(const Measurements& measurements) : measurements_(measurements) {
    for (const Series& series : measurements.series) {
      const std::optional<ContestName> name = Parse(series.name);
      if (name && name->contestant == kOurs) ours_.insert(name->family + "/" + name->instance);
    }
  }

  std::vector<Family> Families() {
    for (const Series& series : measurements_.series) {
      const std::optional<ContestName> name = Parse(series.name);
      if (name && ours_.contains(name->family + "/" + name->instance)) Enter(*name, series);
    }
    for (Family& family : families_) Conclude(family);
    return std::move(families_);
  }

 private:
  void Enter(const ContestName& name, const Series& series) {
    Family& family = FamilyOf(name.family);
    if (!series.wrong.empty()) {
      family.wrong.push_back(
          fmt::format("{}/{}: {}", name.instance, name.contestant, series.wrong));
    } else {
      bench::Enter(ContestOf(family, name.instance), name.contestant, series);
    }
  }

  Family& FamilyOf(const std::string& name) {
    const auto known = std::ranges::find(families_, name, &Family::name);
    if (known != families_.end()) return *known;
    return families_.emplace_back(MakeFamily(name));
  }

  Family MakeFamily(const std::string& name) const {
    Family family = {.name = name,
                     .measured = Told(name + "/measured"),
                     .unfair = Told(name + "/unfair"),
                     .against = Told(name + "/against"),
                     .at_least = ToldNumber(name + "/at_least"),
                     .never_below = ToldNumber(name + "/never_below"),
                     .missing = {},
                     .wrong = {},
                     .contests = {}};
    const std::string prefix = name + "/missing/";
    for (const auto& [key, package] : measurements_.context) {
      if (!key.starts_with(prefix)) continue;
      family.missing.push_back({.peer = key.substr(prefix.size()), .package = package});
    }
    return family;
  }

  static Contest& ContestOf(Family& family, const std::string& instance) {
    const auto known = std::ranges::find(family.contests, instance, &Contest::instance);
    if (known != family.contests.end()) return *known;
    return family.contests.emplace_back(
        Contest{.instance = instance, .ours = {}, .variants = {}, .peers = {}});
  }

  static void Conclude(Family& family) {
    std::erase_if(family.contests,
                  [](const Contest& contest) { return contest.ours.seconds.empty(); });
    for (Contest& contest : family.contests) {
      std::ranges::sort(contest.peers, {}, &PeerTime::peer);
      for (PeerTime& peer : contest.peers) peer.ratio = RatioOf(peer.series, contest.ours);
    }
  }

  std::string Told(const std::string& key) const {
    const auto at = measurements_.context.find(key);
    return at == measurements_.context.end() ? "" : at->second;
  }
  double ToldNumber(const std::string& key) const {
    const std::string text = Told(key);
    return text.empty() ? 0 : std::stod(text);
  }

  const Measurements& measurements_;
  std::set<std::string> ours_;
  std::vector<Family> families_;
};

constexpr std::size_t kFewestOfAKind = 3;

std::string KindOfContest(const Contest& contest) {
  const std::string& label = contest.ours.label;
  return KindOf(contest.instance) + (label.empty() ? "" : ", " + label);
}

Family Empty(Family family, const std::string& name) {
  family.name = name;
  family.contests.clear();
  return family;
}

}  // namespace

bool PeerTime::TimeWasUp() const {
  const auto timeout = series.counters.find(kTimeout);
  return timeout != series.counters.end() && timeout->second != 0;
}

const PeerTime* Contest::Best() const {
  const auto best = std::ranges::min_element(
      peers, {}, [](const PeerTime& peer) { return peer.series.Median(); });
  return best == peers.end() ? nullptr : &*best;
}

const Series* Contest::FindVariant(const std::string& variant) const {
  const auto at = std::ranges::find_if(
      variants, [&](const Series& series) { return series.name.ends_with(":" + variant); });
  return at == variants.end() ? nullptr : &*at;
}

const PeerTime* Contest::Find(const std::string& peer) const {
  const auto at = std::ranges::find(peers, peer, &PeerTime::peer);
  return at == peers.end() ? nullptr : &*at;
}

std::vector<Family> Families(const Measurements& measurements) {
  return Register(measurements).Families();
}

std::vector<Family> ByKind(const Family& family) {
  std::vector<Family> kinds;
  for (const Contest& contest : family.contests) {
    const std::string name = KindOfContest(contest);
    auto known = std::ranges::find(kinds, name, &Family::name);
    if (known == kinds.end()) known = kinds.insert(known, Empty(family, name));
    known->contests.push_back(contest);
  }
  Family others = Empty(family, "others");
  std::erase_if(kinds, [&](const Family& kind) {
    if (kind.contests.size() >= kFewestOfAKind) return false;
    std::ranges::copy(kind.contests, std::back_inserter(others.contests));
    return true;
  });
  if (!others.contests.empty()) kinds.push_back(std::move(others));
  return kinds;
}

double GeometricMean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

std::vector<double> Ratios(const Family& family, const std::string& peer) {
  std::vector<double> ratios;
  for (const Contest& contest : family.contests) {
    const PeerTime* time = peer.empty() ? contest.Best() : contest.Find(peer);
    if (time != nullptr) ratios.push_back(time->ratio.median);
  }
  return ratios;
}

std::vector<std::string> Variants(const Family& family) {
  std::set<std::string> names;
  for (const Contest& contest : family.contests) {
    for (const Series& series : contest.variants) {
      names.insert(series.name.substr(series.name.rfind(':') + 1));
    }
  }
  return {names.begin(), names.end()};
}

std::vector<double> VariantRatios(const Family& family, const std::string& variant,
                                  const std::string& peer) {
  std::vector<double> ratios;
  for (const Contest& contest : family.contests) {
    const PeerTime* of = peer.empty() ? contest.Best() : contest.Find(peer);
    const Series* ours = contest.FindVariant(variant);
    if (of == nullptr || ours == nullptr) continue;
    ratios.push_back(of->series.Median() / ours->Median());
  }
  return ratios;
}

std::vector<std::string> Peers(const Family& family) {
  std::set<std::string> names;
  for (const Contest& contest : family.contests) {
    for (const PeerTime& peer : contest.peers) names.insert(peer.peer);
  }
  return {names.begin(), names.end()};
}

}  // namespace assay::bench
