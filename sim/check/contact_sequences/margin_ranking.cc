#include "sim/check/contact_sequences/margin_ranking.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "planner/base/random.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "sim/check/contact_sequences/rank_correlation.h"

namespace assay::check {
namespace {

constexpr int kDraws = 1000;
constexpr double kTail = 0.025;
// A contact counts if errors of at most this turn, in radians, can lead to it. The search uses the
// same value.
constexpr double kSearchTurn = finemotion::MotionChecker::Options{}.turn;

using Margins = std::map<ContactEvent, double>;

Margins MarginsOf(const finemotion::Passage& passage, const finemotion::FineMotionPlan& plan,
                  double reach) {
  const PlannedContacts planned = PlannedContactsOf(plan);
  Margins margins;
  for (std::size_t i = 0; i < plan.motions.size(); ++i) {
    const int motion = static_cast<int>(i);
    const PlannedContacts::Motion& contacts = planned.motions[i];
    for (const auto& near :
         finemotion::PrimitiveContacts(passage.moving, passage.stationary,
                                       plan.motions[i].X_StationaryAfter, reach, {}, kSearchTurn)) {
      const ContactKey key = finemotion::KeyOf(near);
      if (!contacts.Wants(key)) margins[{motion, key, false}] = finemotion::kBeyondLadder;
    }
    for (const ContactKey& key : contacts.after)
      margins[{motion, key, true}] = finemotion::kBeyondLadder;
    for (const finemotion::Unwanted& unwanted : plan.motions[i].check.unwanted) {
      double& scale =
          margins
              .try_emplace({motion, unwanted.contact, unwanted.is_loss}, finemotion::kBeyondLadder)
              .first->second;
      scale = std::min(scale, unwanted.scale);
    }
  }
  return margins;
}

// The ranked events that one trial shows.
struct Observation {
  int last_motion = 0;                     // the last motion that counts
  std::vector<std::size_t> happened = {};  // indices of ranked contacts
};

// Returns all events with no trial counted yet.
std::vector<RankedContact> Uncounted(const Margins& margins) {
  std::vector<RankedContact> contacts;
  for (const auto& [event, scale] : margins) contacts.push_back({event, scale, 0, 0});
  return contacts;
}

std::vector<Observation> ObservationsOf(const std::vector<RankedContact>& contacts,
                                        std::span<const SequenceComparison> trials) {
  std::vector<Observation> observations;
  for (const SequenceComparison& trial : trials) {
    Observation observation{trial.divergence ? trial.divergence->motion
                                             : std::numeric_limits<int>::max()};
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ContactEvent& event = contacts[i].event;
      if (event.motion > observation.last_motion) continue;
      if (std::ranges::binary_search(trial.events, event)) observation.happened.push_back(i);
    }
    observations.push_back(std::move(observation));
  }
  return observations;
}

// Returns the contacts with counts over the observations that have these numbers.
std::vector<RankedContact> Counted(std::vector<RankedContact> contacts,
                                   const std::vector<Observation>& observations,
                                   std::span<const std::size_t> numbers) {
  std::map<int, int> ended;  // number of trials by their last motion
  for (const std::size_t number : numbers) {
    ++ended[observations[number].last_motion];
    for (const std::size_t i : observations[number].happened) ++contacts[i].happened;
  }
  for (RankedContact& contact : contacts) {
    for (auto it = ended.lower_bound(contact.event.motion); it != ended.end(); ++it)
      contact.trials += it->second;
  }
  std::erase_if(contacts, [](const RankedContact& contact) { return contact.trials == 0; });
  return contacts;
}

std::optional<double> CorrelationOf(const std::vector<RankedContact>& contacts) {
  std::vector<double> likely;
  std::vector<double> frequency;
  for (const RankedContact& contact : contacts) {
    likely.push_back(-contact.scale);
    frequency.push_back(contact.Frequency());
  }
  return RankCorrelation(likely, frequency);
}

// Returns as many elements as `from` has, drawn from it with repetition.
template <class T>
std::vector<T> DrawnAnew(const std::vector<T>& from, RandomStream& random) {
  std::vector<T> drawn;
  for (std::size_t i = 0; i < from.size(); ++i)
    drawn.push_back(from[static_cast<std::size_t>(random.Index(static_cast<int>(from.size())))]);
  return drawn;
}

std::optional<Interval> IntervalOf(const std::vector<RankedContact>& contacts,
                                   const std::vector<Observation>& observations,
                                   const std::vector<std::size_t>& numbers) {
  RandomStream random(kRankingSeed, "rank correlation");
  std::vector<double> drawn;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto counted = Counted(contacts, observations, DrawnAnew(numbers, random));
    if (const auto correlation = CorrelationOf(DrawnAnew(counted, random)))
      drawn.push_back(*correlation);
  }
  if (static_cast<double>(drawn.size()) < (1 - kTail) * kDraws) return std::nullopt;
  std::ranges::sort(drawn);
  const auto at = [&](double share) {
    return drawn[static_cast<std::size_t>(share * static_cast<double>(drawn.size() - 1))];
  };
  return Interval{at(kTail), at(1 - kTail)};
}

}  // namespace

double RankedContact::Frequency() const {
  return trials == 0 ? 0 : static_cast<double>(happened) / trials;
}

MarginRanking RankMargins(const finemotion::Passage& passage,
                          const finemotion::FineMotionPlan& plan, double reach,
                          std::span<const SequenceComparison> trials) {
  Margins margins = MarginsOf(passage, plan, reach);
  for (const SequenceComparison& trial : trials) {
    for (const ContactEvent& event : trial.events)
      margins.try_emplace(event, finemotion::kBeyondLadder);
  }
  const std::vector<RankedContact> contacts = Uncounted(margins);
  const std::vector<Observation> observations = ObservationsOf(contacts, trials);
  std::vector<std::size_t> numbers(trials.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  MarginRanking ranking{.contacts = Counted(contacts, observations, numbers)};
  ranking.correlation = CorrelationOf(ranking.contacts);
  if (ranking.correlation) ranking.interval = IntervalOf(contacts, observations, numbers);
  return ranking;
}

}  // namespace assay::check
