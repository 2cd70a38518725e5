#include "sim/cli/trials/mating_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "planner/base/check.h"
#include "sim/check/trial/error_recognition.h"
#include "sim/cli/plans/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using check::ContactSet;
using finemotion::FineMotionPlan;

std::vector<std::string> NamesOf(const ContactSet& keys) {
  std::vector<std::string> names;
  for (const finemotion::ContactKey& key : keys) names.push_back(finemotion::Name(key));
  return names;
}

std::string ContactsText(const ContactSet& keys) {
  return keys.empty() ? "no contact" : fmt::format("{}", fmt::join(NamesOf(keys), ", "));
}

std::string UnwantedText(const finemotion::Unwanted& unwanted) {
  return fmt::format("{}{} at {:.3g} times the errors", unwanted.is_loss ? "loss of " : "",
                     finemotion::Name(unwanted.contact), unwanted.scale);
}

Json UnwantedJson(const finemotion::Unwanted& unwanted) {
  return {{"contact", finemotion::Name(unwanted.contact)},
          {"loss", unwanted.is_loss},
          {"scale", unwanted.scale}};
}

Json StrategyJson(const FineMotionPlan& plan) {
  Json motions = Json::array();
  for (const finemotion::CertainMotion& motion : plan.motions) {
    const Eigen::VectorXd& d = motion.command.displacement;
    Json until;
    if (motion.command.until) {
      until = {{"contact", finemotion::Name(*motion.command.until)},
               {"longest", motion.check.longest}};
    }
    motions.push_back({{"state", NamesOf(motion.command.kept)},
                       {"velocity", std::vector<double>(d.begin(), d.begin() + 6)},
                       {"until", until}});
  }
  return motions;
}

Json MarginsJson(const FineMotionPlan& plan) {
  Json margins = Json::array();
  int number = 0;
  for (const finemotion::CertainMotion& motion : plan.motions) {
    ++number;
    for (const finemotion::Unwanted& unwanted : motion.check.unwanted) {
      Json margin = {{"motion", number}};
      margin.update(UnwantedJson(unwanted));
      margins.push_back(std::move(margin));
    }
  }
  return margins;
}

const char* NameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFound:
      return "plan";
    case Outcome::kNone:
      return "none";
    case Outcome::kBudget:
      return "budget";
  }
  ASSAY_CHECK(false, "an outcome that the switch does not know");
}

// Returns what stands in the way of a strategy, and how much was searched.
std::string WhyNone(const FineMotionPlan& plan, const finemotion::StrategyOptions& search) {
  const std::string in_the_way =
      plan.obstacle ? "; in the way: " + UnwantedText(*plan.obstacle) : "";
  const std::string looked =
      plan.outcome == Outcome::kNone
          ? fmt::format("all sequences of the planner's maneuvers from {} starts were tried",
                        search.starts)
          : fmt::format(
                "{} nodes for each critical point were not enough to try all sequences; --nodes "
                "raises this limit",
                search.thorough_nodes);
  return fmt::format("{}\n{}\n", in_the_way, looked);
}

// The functions below report the trials.

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
    ++tally.ends[std::string(execution::Name(trial.result.end.outcome))];
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
    ends += fmt::format(", stuck by {} {}", holding, count);
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
  return fmt::format(
      "motion {}: planned {}, observed {}", divergence.motion + 1, ContactsText(divergence.planned),
      divergence.observed ? ContactsText(*divergence.observed) : "its end before that");
}

std::string RecognizedText(const std::optional<execution::RecognizedContact>& recognized) {
  if (!recognized) return {};
  return fmt::format("; by its forces {}{}", recognized->is_loss ? "the loss of " : "",
                     recognized->name);
}

std::string HoldingText(const std::optional<execution::Holding>& holding) {
  return holding ? fmt::format("; what can hold it: {}", execution::Name(*holding)) : "";
}

// Returns a line for each error state that did not end the trial.
std::string ErrorStatesText(int trial, const std::vector<execution::ErrorState>& states,
                            const char* then) {
  std::string text;
  for (const execution::ErrorState& state : states) {
    text += fmt::format("  trial {}: {}: {}{}; {}\n", trial, execution::Name(state.outcome),
                        state.reason, RecognizedText(state.recognized), then);
  }
  return text;
}

// Returns what went wrong in a trial, one event on each line; empty if nothing did.
std::string MatedTrialText(const MatingStudy& study, const MatedTrial& trial) {
  const execution::StrategyEnd& end = trial.result.end;
  std::string text = ErrorStatesText(trial.number, end.recovered, "drew back");
  text += ErrorStatesText(trial.number, end.ignored, "went on");
  if (!trial.seated) {
    text += fmt::format("  trial {}: {}: {}{}{}\n", trial.number, execution::Name(end.outcome),
                        end.reason, HoldingText(end.holding), RecognizedText(end.recognized));
  }
  if (!Matches(trial)) {
    text += fmt::format("  trial {}: {}\n", trial.number,
                        DivergenceText(*trial.sequence->comparison.divergence));
  }
  if (!trial.seated) text += fmt::format("  again: {}{}\n", study.replay, trial.number);
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
        "error states: {} by the engine's contacts; {} recognized as an error state of the plan, "
        "{} of them rightly; {} in trials without an unwanted contact\n",
        states.errors, states.named, states.right, tally.needless);
  }
  if (const auto& trials = tally.unwanted; trials.errors > 0) {
    text +=
        fmt::format("unwanted contacts: made in {} trials; named rightly in {}, wrongly in {}\n",
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
      interval ? fmt::format("95 % in {:.2f} .. {:.2f}", interval->low, interval->high)
               : "too little happened for an interval";
  return fmt::format(
      "margins and frequencies of unwanted contacts: rank correlation {:.2f}, {}, of {} pairs; {} "
      "of them ever happened\n",
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

// Returns the contact that an error state was recognized as, and whether it existed in the engine.
// Null if none was recognized.
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
                    {"end", execution::Name(state.outcome)},
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
          {"end", execution::Name(trial.result.end.outcome)},
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
bool IsTold(const check::RankedContact& contact) {
  return contact.happened > 0 || contact.scale != finemotion::kBeyondLadder;
}

Json RankingJson(const check::MarginRanking& ranking) {
  Json contacts = Json::array();
  for (const check::RankedContact& contact : ranking.contacts) {
    if (!IsTold(contact)) continue;
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

std::string SummaryOf(const finemotion::MatingGeometry& geometry, const FineMotionPlan& plan) {
  return fmt::format(
      "{} critical points; {} motions, certain for {:.2f} times the errors and friction up "
      "to {:.2f}; as planned in {} replays in exact geometry",
      geometry.critical_points.size(), plan.motions.size(), plan.absorbed, plan.friction_limit,
      plan.exact_replays);
}

std::vector<report::MatingSubject::Motion> MotionsOf(const FineMotionPlan& plan) {
  std::vector<report::MatingSubject::Motion> motions;
  for (const finemotion::CertainMotion& motion : plan.motions) {
    const auto& unwanted = motion.check.unwanted;
    motions.push_back(
        {.ends_with = motion.command.until ? finemotion::Name(*motion.command.until) : "its way",
         .contacts = fmt::format("{}", fmt::join(NamesOf(motion.check.after.kept), ", ")),
         .unwanted = unwanted.empty() ? "none" : UnwantedText(unwanted.front())});
  }
  return motions;
}

std::string TextOf(const finemotion::MatingGeometry& geometry, const FineMotionPlan& plan,
                   const finemotion::StrategyOptions& search) {
  if (plan.motions.empty()) {
    return fmt::format("{} critical points; no sequence of contacts was found{}",
                       geometry.critical_points.size(), WhyNone(plan, search));
  }
  Table table({{""}, {"ends with"}, {"in contact after it"}, {"first unwanted"}});
  int number = 0;
  for (const auto& motion : MotionsOf(plan)) {
    table.Add({fmt::format("{}", ++number), motion.ends_with, motion.contacts, motion.unwanted});
  }
  std::string text = fmt::format("{}\n{}", SummaryOf(geometry, plan), table.Text());
  const finemotion::TestComparison& comparison = plan.comparison;
  if (comparison.compared > 0) {
    text += fmt::format("of {} intersections, the edge test was compared in {} and misses {}\n",
                        comparison.tests, comparison.compared, comparison.missed);
  }
  if (!plan.found())
    text += "no strategy was found that absorbs the errors" + WhyNone(plan, search);
  return text;
}

Json ToJson(const finemotion::MatingGeometry& geometry, const FineMotionPlan& plan) {
  Json critical_points = Json::array();
  for (const auto& point : geometry.critical_points) critical_points.push_back(point.travel);
  Json json = {{"outcome", NameOf(plan.outcome)},
               {"critical_points", critical_points},
               {"absorbed", plan.absorbed},
               {"exact_replays", plan.exact_replays},
               {"friction", plan.friction_limit},
               {"intersections",
                {{"tests", plan.comparison.tests},
                 {"compared", plan.comparison.compared},
                 {"missed", plan.comparison.missed}}},
               {"strategy", StrategyJson(plan)},
               {"margins", MarginsJson(plan)}};
  if (!plan.found() && plan.obstacle) json["obstacle"] = UnwantedJson(*plan.obstacle);
  return json;
}

std::string TextOf(const MatingTask& task, const assembly::Unreached& unreached) {
  const std::string where = unreached.motion == 0
                                ? "where it starts"
                                : fmt::format("where motion {} ends", unreached.motion);
  const std::string why = unreached.obstacle.IsNone()
                              ? "the arm does not get there"
                              : fmt::format("the hand would go through '{}'",
                                            task.planned.problem.part(unreached.obstacle).name);
  return fmt::format("the arm cannot execute it with any grasp; with {}, {}, the tool at {}: {}\n",
                     task.assemble.hold.grasp, where,
                     plan::InMillimetres(unreached.X_WorldTool.translation()), why);
}

Json ToJson(const MatingTask& task, const assembly::Unreached& unreached) {
  const geometry::Vector3 at = unreached.X_WorldTool.translation();
  const auto& problem = task.planned.problem;
  return {{"motion", unreached.motion},
          {"tool", {at.x(), at.y(), at.z()}},
          {"obstacle",
           unreached.obstacle.IsNone() ? Json() : Json(problem.part(unreached.obstacle).name)}};
}

int MatingStudy::CoveredFailures() const {
  return static_cast<int>(std::ranges::count_if(
      strategy, [&](const MatedTrial& trial) { return Covers(trial) && !trial.seated; }));
}

std::string TextOf(const MatingStudy& study) {
  std::string text = MatedTrialsText("strategy", study.strategy);
  const SequenceTally tally = SequencesOf(study);
  text += fmt::format("contact sequences: {} of {} as planned; {} of {} that are certain\n",
                      tally.matching, study.strategy.size(), tally.covered_matching, tally.covered);
  for (const MatedTrial& trial : study.strategy) text += MatedTrialText(study, trial);
  if (const int redrawn = TallyOf(study.strategy).redrawn; redrawn > 0)
    text += fmt::format("errors with which no trial can begin: {}, drawn anew\n", redrawn);
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
    if (!IsTold(contact)) continue;
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
