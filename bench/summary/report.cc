#include "bench/summary/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "bench/harness/contest.h"
#include "bench/summary/comparison.h"
#include "bench/summary/growth.h"
#include "bench/summary/markdown.h"

namespace assay::bench {
namespace {

std::string Text(const Ratio& ratio) {
  return fmt::format("{} ({} to {})", Multiple(ratio.median), Multiple(ratio.least),
                     Multiple(ratio.greatest));
}

std::string Wanted(const Family& family) {
  std::vector<std::string> wishes;
  if (family.at_least > 0) {
    wishes.push_back(fmt::format("{} times {}", Multiple(family.at_least),
                                 family.against.empty() ? "the best peer" : family.against));
  }
  if (family.never_below > 0) {
    wishes.push_back(fmt::format("nowhere below {}", Multiple(family.never_below)));
  }
  return fmt::format("{}", fmt::join(wishes, ", "));
}

bool IsMissed(const Family& family) {
  const std::vector<double> best = Ratios(family, "");
  const std::vector<double> wanted = Ratios(family, family.against);
  return (family.at_least > 0 && !wanted.empty() && GeometricMean(wanted) < family.at_least) ||
         (family.never_below > 0 && !best.empty() && std::ranges::min(best) < family.never_below);
}

// Returns whether all peers were measured. A ratio that is reached against some peers may not be
// reached against a missing one.
bool IsMeasured(const Family& family) {
  return family.missing.empty() && !Ratios(family, "").empty() &&
         (family.at_least == 0 || !Ratios(family, family.against).empty());
}

std::string Verdict(const Family& family) {
  const std::string wanted = Wanted(family);
  if (!family.wrong.empty()) {
    return wanted.empty() ? "**wrong answers**" : "**does not hold: wrong answers**";
  }
  if (wanted.empty()) return "";
  if (IsMissed(family)) return "**missed**";
  return IsMeasured(family) ? "holds" : "**not measured**";
}

using Cells = std::vector<std::string>;

std::string Link(const Family& family) { return fmt::format("[{0}](#{0})", family.name); }

Cells RatioCells(const Family& family, const std::string& peer) {
  const std::vector<double> ratios = Ratios(family, peer);
  return {Link(family),
          peer.empty() ? "best of each" : peer,
          fmt::format("{}", ratios.size()),
          Multiple(GeometricMean(ratios)),
          Multiple(std::ranges::min(ratios)),
          Multiple(std::ranges::max(ratios)),
          "",
          ""};
}

Cells MissingCells(const Family& family, const MissingPeer& missing) {
  const std::string why = fmt::format("not measured: {} is not installed", missing.package);
  return {Link(family), missing.peer, "0", why, "", "", "", ""};
}

// Returns the family's rows of the headline. The last row has the verdict, even if no peer was
// measured.
std::vector<Cells> HeadlineOf(const Family& family) {
  std::vector<Cells> rows;
  for (const MissingPeer& missing : family.missing) rows.push_back(MissingCells(family, missing));
  const std::vector<std::string> peers = Peers(family);
  for (const std::string& peer : peers) rows.push_back(RatioCells(family, peer));
  if (peers.size() > 1) rows.push_back(RatioCells(family, ""));
  const std::string wanted = Wanted(family), verdict = Verdict(family);
  if (rows.empty() && wanted.empty() && verdict.empty()) return {};
  if (rows.empty()) rows.push_back({Link(family), "none", "0", "not measured", "", "", "", ""});
  rows.back()[6] = wanted;
  rows.back()[7] = verdict;
  return rows;
}

// Writes the row of a variant of assay beside the peer that counts.
void VariantRow(std::string& out, const Family& family, const std::string& variant) {
  const std::vector<double> ratios = VariantRatios(family, variant, family.against);
  if (ratios.empty()) return;
  out += Row({fmt::format("{}, assay {}", Link(family), variant),
              family.against.empty() ? "best of each" : family.against,
              fmt::format("{}", ratios.size()), Multiple(GeometricMean(ratios)),
              Multiple(std::ranges::min(ratios)), Multiple(std::ranges::max(ratios)), "", ""});
}

void Headline(std::string& out, const std::vector<Family>& families) {
  out +=
      "## Ratios\n\nA ratio is a peer's time divided by the time of assay, on a single thread. The "
      "table has the geometric mean over the instances, the least and the greatest ratio. If a "
      "ratio is above 1, assay is quicker.\n\n";
  out += Heading({"work", "peer", "instances", "ratio", "least", "greatest", "wanted", ""});
  for (const Family& family : families) {
    for (const Cells& cells : HeadlineOf(family)) out += Row(cells);
    for (const std::string& variant : Variants(family)) VariantRow(out, family, variant);
  }
  out += "\n![ratios](plots/ratios.svg)\n\n";
}

void KindRow(std::string& out, const Family& family, const Family& kind, const std::string& peer) {
  const std::vector<double> ratios = Ratios(kind, peer);
  if (ratios.empty()) return;
  out += Row({Link(family), kind.name, fmt::format("{}", ratios.size()),
              peer.empty() ? "best of each" : peer, Multiple(GeometricMean(ratios)),
              Multiple(std::ranges::min(ratios)), Multiple(std::ranges::max(ratios))});
}

// Writes the ratios by kind. A mean over all instances would hide kinds that are far from it.
void KindSection(std::string& out, const std::vector<Family>& families) {
  std::string rows;
  for (const Family& family : families) {
    const std::vector<Family> kinds = ByKind(family);
    if (kinds.size() < 2) continue;
    for (const Family& kind : kinds) {
      if (!family.against.empty()) KindRow(rows, family, kind, family.against);
      if (Peers(kind).size() > 1) KindRow(rows, family, kind, "");
    }
  }
  if (rows.empty()) return;
  out += "## Ratios by kind of instance\n\n";
  out += Heading({"work", "kind", "instances", "peer", "ratio", "least", "greatest"}) + rows + "\n";
}

std::vector<std::string> CounterNames(const Family& family) {
  std::set<std::string> names;
  for (const Contest& contest : family.contests) {
    for (const auto& [name, value] : contest.ours.counters) names.insert(name);
  }
  return {names.begin(), names.end()};
}

// Returns the names of a peer's counters, without those that the report shows in another way.
std::vector<std::string> CounterNames(const Family& family, const std::string& peer) {
  std::set<std::string> names;
  for (const Contest& contest : family.contests) {
    const PeerTime* time = contest.Find(peer);
    if (time == nullptr) continue;
    for (const auto& [name, value] : time->series.counters) {
      if (name != kTimeout && !name.starts_with(kTimesOfPublished)) names.insert(name);
    }
  }
  return {names.begin(), names.end()};
}

std::string Counter(const Series& series, const std::string& name) {
  const auto at = series.counters.find(name);
  return at == series.counters.end() ? "" : fmt::format("{:.4g}", at->second);
}

std::string AtLeast(const PeerTime& peer) { return peer.TimeWasUp() ? "> " : ""; }

std::string PeerCell(const PeerTime* peer) {
  if (peer == nullptr) return "";
  const std::string variant = peer->variant.empty() ? "" : " " + peer->variant;
  return fmt::format("{}{}{}", AtLeast(*peer), Time(peer->series.Median()), variant);
}

std::string VariantCell(const Contest& contest, const std::string& variant) {
  const Series* series = contest.FindVariant(variant);
  return series == nullptr ? "" : Time(series->Median());
}

void Instances(std::string& out, const Family& family) {
  const std::vector<std::string> variants = Variants(family);
  const std::vector<std::string> peers = Peers(family);
  const std::vector<std::string> counters = CounterNames(family);
  std::vector<std::string> heading = {"instance", "assay"};
  heading.insert(heading.end(), variants.begin(), variants.end());
  heading.insert(heading.end(), peers.begin(), peers.end());
  heading.push_back("best peer / assay");
  heading.insert(heading.end(), counters.begin(), counters.end());
  for (const std::string& peer : peers) {
    for (const std::string& name : CounterNames(family, peer))
      heading.push_back(peer + ": " + name);
  }
  out += Heading(heading);
  for (const Contest& contest : family.contests) {
    std::vector<std::string> row = {contest.instance, Time(contest.ours.Median())};
    for (const std::string& variant : variants) row.push_back(VariantCell(contest, variant));
    for (const std::string& peer : peers) row.push_back(PeerCell(contest.Find(peer)));
    const PeerTime* best = contest.Best();
    row.push_back(best != nullptr ? AtLeast(*best) + Text(best->ratio) : "");
    for (const std::string& name : counters) row.push_back(Counter(contest.ours, name));
    for (const std::string& peer : peers) {
      const PeerTime* time = contest.Find(peer);
      for (const std::string& name : CounterNames(family, peer)) {
        row.push_back(time == nullptr ? "" : Counter(time->series, name));
      }
    }
    out += Row(row);
  }
}

void Tell(std::string& out, std::string_view what, const std::string& text) {
  if (!text.empty()) out += fmt::format("{}: {}.\n\n", what, text);
}

void Section(std::string& out, const Family& family) {
  out += fmt::format("### {}\n\n", family.name);
  Tell(out, "Time of", family.measured);
  Tell(out, "Unfair", family.unfair);
  for (const MissingPeer& missing : family.missing) {
    out += fmt::format("Not on this machine: {} ({}).\n\n", missing.peer, missing.package);
  }
  Instances(out, family);
  out += "\n";
  for (const std::string& text : family.wrong) out += fmt::format("**Wrong**: {}.\n\n", text);
}

void GrowthSection(std::string& out, const Measurements& measurements) {
  const std::vector<Growth> growths = Growths(measurements);
  if (growths.empty()) return;
  out +=
      "## Growth\n\nTimes grow in proportion to a power of the size. The exponent is fitted by "
      "least squares in logarithms.\n\n";
  out += Heading({"program", "work", "size", "from", "to", "least", "greatest", "exponent"});
  for (const Growth& growth : growths) {
    const Growth::Point& first = growth.points.front();
    const Growth::Point& last = growth.points.back();
    out += Row({growth.program, growth.name, growth.of, fmt::format("{:g}", first.size),
                fmt::format("{:g}", last.size), Time(first.seconds), Time(last.seconds),
                fmt::format("{:.2f}", growth.Exponent())});
  }
  out += "\n![growth](plots/growth.svg)\n\n";
}

std::optional<double> LimitOf(const Series& series) {
  const auto limit = series.counters.find("at_most_ms");
  if (limit == series.counters.end()) return std::nullopt;
  return limit->second * 1e-3;
}

// Returns the time to which the limit applies. If one benchmark asks many questions, it is the time
// of the slowest question in the first pass.
double LimitedSeconds(const Series& series) {
  const auto slowest = series.counters.find("slowest_ms");
  const bool is_of_many = series.wrong.empty() && slowest != series.counters.end();
  return is_of_many ? slowest->second * 1e-3 : series.Median();
}

bool IsWithin(const Series& series, double limit) { return LimitedSeconds(series) <= limit; }

std::string Limit(const Series& series) {
  const std::optional<double> limit = LimitOf(series);
  if (!limit) return "";
  return fmt::format("at most {}: {}", Time(*limit),
                     IsWithin(series, *limit) ? "holds" : "**missed**");
}

// The benchmarks of one name with one limit, and the slowest of them.
struct LimitedWork {
  std::string program;
  std::string work;
  double limit = 0;
  int benchmarks = 0;
  int held = 0;
  const Series* slowest = nullptr;
};

std::vector<LimitedWork> LimitedWorks(const Measurements& measurements) {
  std::vector<LimitedWork> works;
  for (const Series& series : measurements.series) {
    const std::optional<double> limit = LimitOf(series);
    if (!limit) continue;
    const std::string work = series.name.substr(0, series.name.find('/'));
    auto known = std::ranges::find_if(works, [&](const LimitedWork& w) {
      return w.program == series.program && w.work == work && w.limit == *limit;
    });
    if (known == works.end()) known = works.insert(known, {series.program, work, *limit});
    ++known->benchmarks;
    known->held += IsWithin(series, *limit) ? 1 : 0;
    if (!known->slowest || LimitedSeconds(series) > LimitedSeconds(*known->slowest)) {
      known->slowest = &series;
    }
  }
  return works;
}

// Writes what the times measure. The section of a family says this for the family.
void TellWhatIsMeasured(std::string& out, const std::vector<LimitedWork>& works,
                        const Measurements& measurements, const std::vector<Family>& families) {
  for (const LimitedWork& work : works) {
    const auto told = measurements.context.find(work.work + "/measured");
    if (told == measurements.context.end()) continue;
    if (std::ranges::find(families, work.work, &Family::name) != families.end()) continue;
    Tell(out, "Time of " + work.work, told->second);
  }
}

void LimitSection(std::string& out, const Measurements& measurements,
                  const std::vector<Family>& families) {
  const std::vector<LimitedWork> works = LimitedWorks(measurements);
  if (works.empty()) return;
  out += "## Times that are wanted\n\n";
  out += Heading({"program", "work", "at most", "benchmarks", "slowest", "its time", ""});
  for (const LimitedWork& work : works) {
    out += Row({work.program, work.work, Time(work.limit), fmt::format("{}", work.benchmarks),
                work.slowest->name, Time(LimitedSeconds(*work.slowest)),
                work.held == work.benchmarks
                    ? "holds"
                    : fmt::format("**missed** by {}", work.benchmarks - work.held)});
  }
  out += "\n";
  TellWhatIsMeasured(out, works, measurements, families);
}

std::string CountersText(const Series& series) {
  std::vector<std::string> texts;
  for (const auto& [name, value] : series.counters) {
    if (name != "at_most_ms") texts.push_back(fmt::format("{} {:.4g}", name, value));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

void AloneSection(std::string& out, const Measurements& measurements,
                  const std::vector<Family>& families) {
  std::set<std::string> in_families;
  for (const Family& family : families) in_families.insert(family.name);
  out += "## Without a peer\n\n";
  std::string program;
  bool is_first = true;
  for (const Series& series : measurements.series) {
    if (in_families.contains(series.name.substr(0, series.name.find('/')))) continue;
    if (is_first || series.program != program) {
      if (!is_first) out += "\n";
      if (!series.program.empty()) out += fmt::format("### {}\n\n", series.program);
      out += Heading({"work", "time", "wanted", "counters"});
    }
    is_first = false;
    program = series.program;
    const std::string time =
        series.wrong.empty() ? Time(series.Median()) : "**wrong**: " + series.wrong;
    out += Row({series.name, time, Limit(series), CountersText(series)});
  }
  out += "\n";
}

// Writes the wrong answers. The wrong answers come first, since nothing below can make up for a
// wrong answer.
void WrongSection(std::string& out, const Measurements& measurements) {
  const std::vector<const Series*> wrong = measurements.Wrong();
  if (wrong.empty()) return;
  out += "## Wrong answers\n\nWho answered wrong in any pass has no time.\n\n";
  for (const Series* series : wrong) {
    out += fmt::format("- {}: **{}**\n", series->name, series->wrong);
  }
  out += "\n";
}

}  // namespace

std::string Report(const Measurements& measurements) {
  const std::vector<Family> families = Families(measurements);
  std::string out =
      "# Benchmarks\n\nMade by `bench/run.sh`. All times are medians over passes. In a pass, all "
      "contestants take turns. The times are processor times of a single thread. Where a section "
      "says so, they are times of the wall clock, and the contestants run one after another. A "
      "contestant's answer is compared with that of assay before its time counts. The mark \">\" "
      "means that a contestant had not answered when its time was up. It then counts as if it had "
      "answered at this moment.\n\n";
  WrongSection(out, measurements);
  if (!families.empty()) Headline(out, families);
  KindSection(out, families);
  LimitSection(out, measurements, families);
  if (!families.empty()) out += "## Instances\n\n";
  for (const Family& family : families) Section(out, family);
  GrowthSection(out, measurements);
  AloneSection(out, measurements, families);
  return out + Where(measurements);
}

}  // namespace assay::bench
