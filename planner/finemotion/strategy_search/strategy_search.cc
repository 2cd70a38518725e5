#include "planner/finemotion/strategy_search/strategy_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/base/random.h"
#include "planner/finemotion/forces/friction_limit.h"
#include "planner/finemotion/strategy_checks/exact_replay.h"
#include "planner/finemotion/strategy_checks/sequence_replay.h"

namespace assay::finemotion {

namespace {

// Factors by which the errors are enlarged for a search. A sequence that is certain for larger
// errors is certain for smaller ones. For the smaller ones it is not always found, since parts that
// are less tilted come nearer to having parallel edges.
constexpr double kEnlargements[] = {1, 2};
// The fractions of the errors for which sequences are searched for, round by round.
constexpr double kMultiples[] = {0.8, 0.7, 1, 0.5, 0.3, 0.15};
constexpr double kDiverseMultiples[] = {0.8, 0.7, 1, 0.5};
// The farthest start beside the entry, and the radius that makes turns lengths, for diverse
// searches, as multiples of the tip's size.
constexpr double kOffsetOfTip = 0.55;
constexpr double kRadiusOfTip = 0.8;
// Where too little is absorbed, sequences for smaller errors are searched for. Each search uses
// kFewer times the errors of the previous search, down to the fraction kFewest of all errors.
constexpr double kFewer = 0.7;
constexpr double kFewest = 0.01;
// The exact replays end when a smaller fraction is left of the errors that are certain to first
// order.
constexpr double kLeastAbsorbed = 0.1;

// The parameters of one search.
struct Attempt {
  SequenceSearch::Effort effort = SequenceSearch::Effort::kGuided;
  int round = 0;        // the round that draws the starts
  double multiple = 1;  // factor of the attempt's errors for which a sequence is searched for
  // The attempt's errors, divided by the errors that the strategy is to absorb.
  double enlarged = 1;
  double asked() const { return 1 / enlarged; }
};

class StrategySearch {
 public:
  StrategySearch(const Passage& passage, const FineMotionErrors& errors,
                 const StrategyOptions& options)
      : passage_(passage),
        errors_(errors),
        options_(options),
        maneuvering_(
            ManeuveringThrough(passage, CheckerFor(passage, errors, options), options.reach)),
        tip_(TipSize(passage)) {}

  FineMotionPlan Run() {
    SearchGuided();
    SearchDiversely();
    Outcome otherwise = Outcome::kBudget;
    if (!IsFound() && options_.thorough_nodes > 0) {
      otherwise = LookThroughAll();
      SearchForFewerErrors();
    }
    best_.outcome = IsFound() ? Outcome::kFound : otherwise;
    best_.expanded = expanded_;
    best_.replayed = replayed_;
    best_.comparison = comparison_;
    return std::move(best_);
  }

 private:
  // The state of one attempt. Multiples are multiples of the attempt's errors.
  struct Trying {
    Trying(const StrategySearch& search, const Attempt& with)
        : attempt(with),
          options(search.OptionsOf(with.effort)),
          errors(Enlarged(search.errors_, with.enlarged)),
          random(options.seed, fmt::format("starts of strategies {}", with.round)),
          starts(search.passage_, errors, options, random),
          problem{search.passage_, search.maneuvering_, options, with.multiple},
          sequences(problem, starts, with.effort),
          replay(problem, starts) {}
    Trying(const Trying&) = delete;

    Attempt attempt;
    StrategyOptions options;
    FineMotionErrors errors;
    RandomStream random;
    Starts starts;
    SequenceProblem problem;
    SequenceSearch sequences;
    SequenceReplay replay;
  };

  bool IsFound() const { return best_.absorbed >= 1; }

  void SearchGuided() {
    for (int round = 0; round < options_.rounds; ++round) {
      const double multiple = kMultiples[static_cast<std::size_t>(round) % std::size(kMultiples)];
      for (const double enlarged : kEnlargements) {
        if (!IsFound()) SearchOnce({.round = round, .multiple = multiple, .enlarged = enlarged});
      }
    }
  }

  void SearchDiversely() {
    for (int round = 0; round < options_.diverse_rounds && !IsFound(); ++round) {
      SearchOnce(
          {.effort = SequenceSearch::Effort::kDiverse,
           .round = options_.rounds + 1 + round,
           .multiple =
               kDiverseMultiples[static_cast<std::size_t>(round) % std::size(kDiverseMultiples)]});
    }
  }

  StrategyOptions OptionsOf(SequenceSearch::Effort effort) const {
    StrategyOptions options = options_;
    if (effort != SequenceSearch::Effort::kDiverse) return options;
    options.nodes = options.diverse_nodes;
    options.offset = std::min(options.offset, kOffsetOfTip * tip_);
    options.radius = std::min(options.radius, kRadiusOfTip * tip_);
    return options;
  }

  // Searches like the first round, for smaller errors. The errors decide how far up the starts are,
  // too.
  void SearchForFewerErrors() {
    for (double share = kFewer; best_.absorbed < options_.greatest * share && share > kFewest;
         share *= kFewer)
      SearchOnce({.multiple = kMultiples[0], .enlarged = share});
  }

  void SearchOnce(const Attempt& attempt) {
    Trying trying(*this, attempt);
    if (auto sequence = trying.sequences.Next()) {
      const double absorbed = trying.replay.Widen(*sequence, attempt.multiple);
      Keep(PlanOf(*sequence, absorbed, trying));
    } else {
      TellRefusal(trying);
    }
    Count(trying);
  }

  // Examines all sequences with all of the errors. A sequence that exact geometry contradicts does
  // not count.
  Outcome LookThroughAll() {
    Trying trying(*this, {.effort = SequenceSearch::Effort::kThorough, .round = options_.rounds});
    while (!IsFound()) {
      auto sequence = trying.sequences.Next();
      if (!sequence) break;
      FineMotionPlan plan = PlanOf(*sequence, 1, trying);
      if (!Replayed(plan, 1).deviation)
        plan = PlanOf(*sequence, trying.replay.Widen(*sequence, 1), trying);
      Keep(std::move(plan));
    }
    if (best_.absorbed == 0) TellRefusal(trying);
    Count(trying);
    return trying.sequences.has_looked_through_all() ? Outcome::kNone : Outcome::kBudget;
  }

  void Count(const Trying& trying) {
    expanded_ += trying.sequences.expanded();
    replayed_ += trying.replay.replayed();
    comparison_ += trying.sequences.comparison();
    comparison_ += trying.replay.comparison();
  }

  // Stores the unwanted contact, or the lost contact, that made the search fail, until a strategy
  // for some errors is found. Later searches are for smaller errors, so the latest one is kept.
  void TellRefusal(const Trying& trying) {
    if (best_.absorbed > 0 || !trying.sequences.refused()) return;
    best_.obstacle = trying.sequences.refused();
    best_.obstacle->scale = trying.attempt.multiple * trying.attempt.enlarged;
  }

  // Returns the plan for a sequence. `absorbed` is a factor of the attempt's errors. The plan's own
  // `absorbed` and the scales of its unwanted contacts are factors of the errors that the strategy
  // is to absorb.
  FineMotionPlan PlanOf(const Sequence& sequence, double absorbed, Trying& trying) const {
    const Attempt& attempt = trying.attempt;
    FineMotionPlan plan;
    if (absorbed < attempt.asked())
      absorbed = GreatestCertain(sequence, absorbed, trying, plan.obstacle);
    plan.X_StationaryStart =
        trying.starts.BelievedPoseAt(sequence.start, absorbed).X_StationaryMoving;
    plan.maneuvers = sequence.maneuvers;
    AddMotions(sequence, absorbed, trying, plan);
    plan.absorbed = absorbed * attempt.enlarged;
    AddFrictionLimit(plan);
    return plan;
  }

  // Returns the greatest multiple for which the sequence is certain, and stores what happens first
  // beyond it.
  double GreatestCertain(const Sequence& sequence, double absorbed, Trying& trying,
                         std::optional<Unwanted>& obstacle) const {
    while (absorbed < trying.attempt.asked()) {
      const double more = kGrowth * absorbed;
      const ReplayedSequence replay = trying.replay.Replay(sequence, more, Margins::kNone);
      if (!replay.certain) {
        obstacle = replay.unwanted;
        if (obstacle) obstacle->scale = more * trying.attempt.enlarged;
        break;
      }
      absorbed = more;
    }
    return absorbed;
  }

  // Adds all motions. They are checked with the absorbed errors or with the errors that the
  // strategy is to absorb, whichever are smaller.
  void AddMotions(const Sequence& sequence, double absorbed, Trying& trying,
                  FineMotionPlan& plan) const {
    const double asked = trying.attempt.asked();
    const double multiple = std::min(asked, absorbed);
    plan.motions = trying.replay.Replay(sequence, multiple, Margins::kAll).motions;
    if (multiple < asked) {
      for (CertainMotion& motion : plan.motions) {
        for (Unwanted& unwanted : motion.check.unwanted) unwanted.scale *= multiple / asked;
      }
    }
    // With greater errors a contact may come later, so the motions last longer.
    const auto most = trying.replay.Replay(sequence, absorbed, Margins::kNone);
    for (std::size_t i = 0; i < std::min(most.motions.size(), plan.motions.size()); ++i) {
      double& longest = plan.motions[i].check.longest;
      longest = std::max(longest, most.motions[i].check.longest);
    }
  }

  // Sets the friction limit. If no motion has a limit below kGreatestFriction, it is
  // kGreatestFriction or the friction of the options, whichever is greater.
  void AddFrictionLimit(FineMotionPlan& plan) const {
    plan.friction_limit = std::max(kGreatestFriction, options_.friction);
    for (const CertainMotion& motion : plan.motions) {
      const double limit = FrictionLimitOf(motion);
      if (limit < kGreatestFriction) plan.friction_limit = std::min(plan.friction_limit, limit);
    }
  }

  void Keep(FineMotionPlan plan) {
    AbsorbWhatIsConfirmed(plan);
    if (plan.absorbed >= 1) plan.obstacle.reset();
    if (plan.absorbed > best_.absorbed)
      best_ = std::move(plan);
    else if (best_.absorbed == 0)
      best_.obstacle = plan.obstacle;
  }

  // Reduces what the plan absorbs until exact replays confirm it. Rows are linear, and what they
  // leave out grows with the square of the errors.
  void AbsorbWhatIsConfirmed(FineMotionPlan& plan) const {
    for (const double least = kLeastAbsorbed * plan.absorbed; plan.absorbed >= least;) {
      const ExactReplays replays = Replayed(plan, plan.absorbed);
      if (!replays.deviation) {
        plan.exact_replays = replays.tried;
        return;
      }
      plan.obstacle = replays.deviation->unwanted;
      plan.obstacle->scale = plan.absorbed;
      const double less = plan.absorbed / kGrowth;
      plan.absorbed = plan.absorbed > 1 ? std::max(1.0, less) : less;
    }
    plan.absorbed = 0;
  }

  // Replays the plan in exact geometry with this multiple of the errors.
  ExactReplays Replayed(const FineMotionPlan& plan, double multiple) const {
    const ExactReplay replay{.passage = passage_,
                             .X_StationaryStart = plan.X_StationaryStart,
                             .motions = plan.motions,
                             .radius = options_.radius,
                             .velocity_error = errors_.velocity};
    return ReplayWithErrors(replay, multiple * errors_.pose, options_.drawn, options_.seed);
  }

  const Passage& passage_;
  const FineMotionErrors& errors_;
  const StrategyOptions& options_;
  std::vector<Maneuvering> maneuvering_;  // one for each critical point
  double tip_;                            // TipSize
  FineMotionPlan best_;
  int expanded_ = 0;
  int replayed_ = 0;
  TestComparison comparison_ = {};
};

}  // namespace

FineMotionPlan SearchStrategy(const Passage& passage, const FineMotionErrors& errors,
                              const StrategyOptions& options) {
  return StrategySearch(passage, errors, options).Run();
}

}  // namespace assay::finemotion
