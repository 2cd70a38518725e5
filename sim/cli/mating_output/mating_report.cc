#include "sim/cli/mating_output/mating_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "sim/check/contact_sequences/error_recognition.h"
#include "sim/cli/mating_output/fine_motion_report.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using check::ContactSet;

std::string ContactsText(const ContactSet& keys) {
  return keys.empty() ? "no contact" : fmt::format("{}", fmt::join(NamesOf(keys), ", "));
}

struct MatedTally {
  int seated = 0;
  int recovered = 0;  // seated at a later attempt
  int redrawn = 0;
  std::map<std::string, int> ends;
  std::map<std::string, int> holdings;  // reasons why trials got stuck
  double greatest_force = 0;
};

MatedTally TallyOf(const std::vector<MatedTrial>& trials) {
  MatedTally tally;
  for (const MatedTrial& trial : trials) {
    if (trial.seated) ++tally.seated;
    tally.redrawn += trial.redrawn;
    if (trial.seated && !trial.result.end.recovered.empty()) ++tally.recovered;
    ++tally.ends[std::string(NameOfEnd(trial.result.end.outcome))];
    if (const auto& holding = trial.result.end.holding)
      ++tally.holdings[std::string(execution::Name(*holding))];
    tally.greatest_force = std::max(tally.greatest_force, trial.result.greatest_force);
  }
  return tally;
}

std::string MatedTrialsText(const char* name, const std::vector<MatedTrial>& trials) {
  const MatedTally tally = TallyOf(trials);
  std::string ends;
  for (const auto& [end, count] : tally.ends) ends += fmt::format(", {} {}", end, count);
  for (const auto& [holding, count] : tally.holdings)
    ends += fmt::format(", stuck by {} {}", holding == "nothing" ? "no contact" : holding, count);
  if (tally.recovered > 0) ends += fmt::format(", {} at a later attempt", tally.recovered);
  return fmt::format("{}: {} of {} seated{}; at most {:.0f} N\n", name, tally.seated, trials.size(),
                     ends, tally.greatest_force);
}

Json MatedTrialsJson(const std::vector<MatedTrial>& trials) {
  const MatedTally tally = TallyOf(trials);
  return {{"seated", tally.seated},
          {"recovered", tally.recovered},
          {"ends", tally.ends},
          {"stuck_by", tally.holdings},
          {"force", tally.greatest_force}};
}

bool Matches(const MatedTrial& trial) { return trial.sequence->comparison.matches(); }

struct SequenceTally {
  int matching = 0;
  int covered = 0;
  int covered_matching = 0;
  int points = 0;
  int unmapped = 0;
  std::string first_unmapped = {};
};

SequenceTally SequencesOf(const MatingStudy& study) {
  SequenceTally tally;
  for (const MatedTrial& trial : study.strategy) {
    const bool covered = study.Covers(trial);
    if (covered) ++tally.covered;
    if (Matches(trial)) ++(covered ? tally.covered_matching : tally.matching);
    const check::ObservedContacts& contacts = trial.sequence->contacts;
    if (tally.unmapped == 0 && contacts.unmapped > 0) {
      tally.first_unmapped = fmt::format("trial {}: {}", trial.number, contacts.first_unmapped);
    }
    tally.points += contacts.points;
    tally.unmapped += contacts.unmapped;
  }
  tally.matching += tally.covered_matching;
  return tally;
}

std::string DivergenceText(const check::Divergence& divergence) {
  return fmt::format("motion {}: planned {}, observed {}", divergence.motion + 1,
                     ContactsText(divergence.planned),
                     divergence.observed ? ContactsText(*divergence.observed)
                                         : "the end of the motion before this");
}

std::string RecognizedText(const std::optional<execution::RecognizedContact>& recognized) {
  if (!recognized) return {};
  return fmt::format("; recognized by its forces: {}{}", recognized->is_loss ? "the loss of " : "",
                     recognized->name);
}

std::string HoldingText(const std::optional<execution::Holding>& holding) {
  return holding ? fmt::format("; it may be held by: {}", execution::Name(*holding)) : "";
}

// Returns a line for each error state that did not end the trial.
std::string ErrorStatesText(int trial, const std::vector<execution::ErrorState>& states,
                            const char* then) {
  std::string text;
  for (const execution::ErrorState& state : states) {
    text += fmt::format("  trial {}: {}: {}{}; {}\n", trial, NameOfEnd(state.outcome), state.reason,
                        RecognizedText(state.recognized), then);
  }
  return text;
}

// Returns what went wrong in a trial, one event on each line; empty if nothing did.
std::string MatedTrialText(const MatingStudy& study, const MatedTrial& trial) {
  const execution::StrategyEnd& end = trial.result.end;
  std::string text = ErrorStatesText(trial.number, end.recovered, "the arm drew back");
  text += ErrorStatesText(trial.number, end.ignored, "the arm went on");
  if (!trial.seated) {
    text += fmt::format("  trial {}: {}: {}{}{}\n", trial.number, NameOfEnd(end.outcome),
                        end.reason, HoldingText(end.holding), RecognizedText(end.recognized));
  }
  if (!Matches(trial)) {
    text += fmt::format("  trial {}: {}\n", trial.number,
                        DivergenceText(*trial.sequence->comparison.divergence));
  }
  if (!trial.seated) text += fmt::format("  to repeat it: {}{}\n", study.replay, trial.number);
  return text;
}

// Counts the error states of all trials, except those in the crevice, where no contacts are
// planned.
check::RecognitionTally RecognitionOf(const MatingStudy& study) {
  check::RecognitionTally tally;
  for (const MatedTrial& trial : study.strategy) {
    const auto& events = trial.sequence->comparison.events;
    const bool diverged = std::ranges::any_of(
        events, [](const check::ContactEvent& event) { return !event.is_loss; });
    check::Count(trial.result.end, check::Bridged(trial.sequence->contacts.spans), diverged, tally);
  }
  return tally;
}

std::string RecognitionText(const check::RecognitionTally& tally) {
  std::string text;
  if (const auto& states = tally.states; states.errors > 0) {
    text += fmt::format(
        "error states: the engine's contacts show {}; the controller recognized {} as an error "
        "state of the plan, {} of these rightly; it reported {} in trials without an unwanted "
        "contact\n",
        states.errors, states.named, states.right, tally.needless);
  }
  if (const auto& trials = tally.unwanted; trials.errors > 0) {
    text += fmt::format(
        "unwanted contacts: they happened in {} trials; the controller named them rightly in {} "
        "and wrongly in {}\n",
        trials.errors, trials.right, trials.named - trials.right);
  }
  return text;
}

std::string RankingText(const check::MarginRanking& ranking) {
  if (!ranking.correlation) {
    return "margins and frequencies of unwanted contacts: not enough variation\n";
  }
  const auto happened = std::ranges::count_if(
      ranking.contacts, [](const check::RankedContact& contact) { return contact.happened > 0; });
  const auto& interval = ranking.interval;
  const std::string within =
      interval ? fmt::format("95 % interval {:.2f} to {:.2f}", interval->low, interval->high)
               : "too few events for an interval";
  return fmt::format(
      "margins and frequencies of unwanted contacts: rank correlation {:.2f}, {}, of {} pairs; {} "
      "of these happened\n",
      *ranking.correlation, within, ranking.contacts.size(), happened);
}

Json DivergenceJson(const check::Divergence& divergence) {
  return {{"motion", divergence.motion + 1},
          {"time", divergence.time},
          {"planned", NamesOf(divergence.planned)},
          {"observed", divergence.observed ? Json(NamesOf(*divergence.observed)) : Json()}};
}

Json EventJson(const check::ContactEvent& event) {
  return {{"motion", event.motion + 1},
          {"contact", finemotion::Name(event.contact)},
          {"loss", event.is_loss}};
}

Json SequenceJson(const SequenceRecord& sequence) {
  Json states = Json::array();
  for (const check::ObservedState& state : sequence.states) {
    states.push_back({{"state", NamesOf(state.contacts)},
                      {"motion", state.motion + 1},
                      {"start", state.start},
                      {"dwell", state.dwell}});
  }
  Json events = Json::array();
  for (const check::ContactEvent& event : sequence.comparison.events)
    events.push_back(EventJson(event));
  const auto& divergence = sequence.comparison.divergence;
  return {{"matches", sequence.comparison.matches()},
          {"divergence", divergence ? DivergenceJson(*divergence) : Json()},
          {"edit_distance", sequence.comparison.edit_distance},
          {"unwanted", events},
          {"states", states},
          {"points", sequence.contacts.points},
          {"unmapped", sequence.contacts.unmapped}};
}

Json RecognitionJson(const check::Recognition& recognition) {
  return {
      {"errors", recognition.errors}, {"named", recognition.named}, {"right", recognition.right}};
}

Json RecognitionJson(const check::RecognitionTally& tally) {
  Json json = RecognitionJson(tally.states);
  json["needless"] = tally.needless;
  json["unwanted"] = RecognitionJson(tally.unwanted);
  return json;
}

// Returns the contact by which an error state was recognized, and whether the engine had this
// contact. Returns null if no contact was recognized.
Json RecognizedJson(const std::optional<execution::RecognizedContact>& recognized,
                    const SequenceRecord& sequence) {
  if (!recognized) return {};
  const auto bridged = check::Bridged(sequence.contacts.spans);
  return {{"contact", recognized->name},
          {"loss", recognized->is_loss},
          {"right", check::IsRight(*recognized, bridged)}};
}

Json HoldingJson(const std::optional<execution::Holding>& holding) {
  return holding ? Json(execution::Name(*holding)) : Json();
}

Json ErrorStatesJson(const std::vector<execution::ErrorState>& states,
                     const SequenceRecord& sequence) {
  Json json = Json::array();
  for (const execution::ErrorState& state : states) {
    json.push_back({{"motion", state.motion + 1},
                    {"end", NameOfEnd(state.outcome)},
                    {"reason", state.reason},
                    {"holding", HoldingJson(state.holding)},
                    {"recognized", RecognizedJson(state.recognized, sequence)}});
  }
  return json;
}

Json MatedTrialJson(const MatingStudy& study, const MatedTrial& trial) {
  return {{"trial", trial.number},
          {"scale", trial.scale},
          {"redrawn", trial.redrawn},
          {"covered", study.Covers(trial)},
          {"seated", trial.seated},
          {"end", NameOfEnd(trial.result.end.outcome)},
          {"reason", trial.result.end.reason},
          {"holding", HoldingJson(trial.result.end.holding)},
          {"recognized", RecognizedJson(trial.result.end.recognized, *trial.sequence)},
          {"recovered", ErrorStatesJson(trial.result.end.recovered, *trial.sequence)},
          {"ignored", ErrorStatesJson(trial.result.end.ignored, *trial.sequence)},
          {"force", trial.result.greatest_force},
          {"simulated", trial.result.duration},
          {"sequence", SequenceJson(*trial.sequence)},
          {"replay", fmt::format("{}{}", study.replay, trial.number)}};
}

// Returns whether a contact is listed. Most contacts neither happened nor have a margin.
bool IsListed(const check::RankedContact& contact) {
  return contact.happened > 0 || contact.scale != finemotion::kBeyondLadder;
}

Json RankingJson(const check::MarginRanking& ranking) {
  Json contacts = Json::array();
  for (const check::RankedContact& contact : ranking.contacts) {
    if (!IsListed(contact)) continue;
    Json row = EventJson(contact.event);
    row.update(
        {{"scale", contact.scale}, {"happened", contact.happened}, {"trials", contact.trials}});
    contacts.push_back(std::move(row));
  }
  const auto& interval = ranking.interval;
  return {{"correlation", ranking.correlation ? Json(*ranking.correlation) : Json()},
          {"interval", interval ? Json({interval->low, interval->high}) : Json()},
          {"ranked", ranking.contacts.size()},
          {"contacts", contacts}};
}

}  // namespace

int MatingStudy::CoveredFailures() const {
  return static_cast<int>(std::ranges::count_if(
      strategy, [&](const MatedTrial& trial) { return Covers(trial) && !trial.seated; }));
}

std::string TextOf(const MatingStudy& study) {
  std::string text = MatedTrialsText("strategy", study.strategy);
  const SequenceTally tally = SequencesOf(study);
  text += fmt::format(
      "contact sequences: {} of {} as planned; {} of {} among trials whose errors the strategy "
      "absorbs\n",
      tally.matching, study.strategy.size(), tally.covered_matching, tally.covered);
  for (const MatedTrial& trial : study.strategy) text += MatedTrialText(study, trial);
  if (const int redrawn = TallyOf(study.strategy).redrawn; redrawn > 0)
    text += fmt::format(
        "errors with which the parts would overlap at the start: {} draws, which were repeated\n",
        redrawn);
  if (tally.unmapped > 0) {
    text += fmt::format(
        "contact points of the engine that belong to no contact of the model: {} of {}; first {}\n",
        tally.unmapped, tally.points, tally.first_unmapped);
  }
  text += RecognitionText(RecognitionOf(study));
  return text + RankingText(study.ranking) + MatedTrialsText("straight", study.straight);
}

report::MatingSubject::Trials TrialsOf(const MatingStudy& study) {
  report::MatingSubject::Trials trials{.outcome = MatedTrialsText("strategy", study.strategy),
                                       .ranking = RankingText(study.ranking),
                                       .contacts = {}};
  for (const check::RankedContact& contact : study.ranking.contacts) {
    if (!IsListed(contact)) continue;
    const auto& [motion, key, is_loss] = contact.event;
    const bool is_beyond = contact.scale == finemotion::kBeyondLadder;
    trials.contacts.push_back(
        {.motion = fmt::format("{}", motion + 1),
         .contact = fmt::format("{}{}", is_loss ? "loss of " : "", finemotion::Name(key)),
         .scale = is_beyond ? "more than 4" : fmt::format("{:g}", contact.scale),
         .happened = fmt::format("{} of {}", contact.happened, contact.trials)});
  }
  return trials;
}

Json ToJson(const MatingStudy& study) {
  Json rows = Json::array();
  for (const MatedTrial& trial : study.strategy) rows.push_back(MatedTrialJson(study, trial));
  const SequenceTally tally = SequencesOf(study);
  return {{"number", study.strategy.size()},
          {"strategy", MatedTrialsJson(study.strategy)},
          {"straight", MatedTrialsJson(study.straight)},
          {"sequences",
           {{"matching", tally.matching},
            {"covered", tally.covered},
            {"covered_matching", tally.covered_matching},
            {"points", tally.points},
            {"unmapped", tally.unmapped}}},
          {"recognition", RecognitionJson(RecognitionOf(study))},
          {"ranking", RankingJson(study.ranking)},
          {"rows", rows}};
}

}  // namespace assay::cli
