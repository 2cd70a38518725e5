#include "planner/posting/uncertainty_phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <tuple>

#include "planner/base/check.h"
#include "planner/posting/best_known.h"
#include "planner/posting/combinations.h"
#include "planner/posting/sensing_resolver.h"
#include "planner/posting/squeezing_resolver.h"
#include "planner/posting/verification.h"
#include "planner/uncertainty/world_tree.h"

namespace assay::posting {

using plan::Resolution;
using uncertainty::CertifiedStep;
using uncertainty::MomentId;
using uncertainty::UncertainWorld;
using uncertainty::Unproved;
using uncertainty::WorldTree;

namespace {

// Goals of a step that were not proved as it was then to be executed.
struct Unmet {
  MomentId after;
  std::vector<std::string> absorbed;  // conditions that were taken care of

  bool operator==(const Unmet&) const = default;
};

// A resolution whose reasons are put in words where the plan is written out.
struct Measure {
  std::string resolver;
  std::vector<plan::StepId> steps = {};  // that it inserted, in the order of execution
  Unmet because;
  // That parts are moved is explained: with the best that does without, something is still unmet.
  struct WithoutMoving {
    std::string resolver;
    Unmet still;
  };
  std::optional<WithoutMoving> without_moving = {};
};

// One step of the instance as it is augmented.
struct Entry {
  plan::StepId id;
  plan::Action action;
  std::vector<Measure> measures = {};
  std::vector<std::string> absorbed = {};  // conditions that a remedy takes care of
  std::optional<plan::Strategy> strategy = {};
  bool given_up = false;               // its goals cannot all be proved
  MomentId failed = MomentId::None();  // the moment after it, if they are not

  const plan::Strategy* way() const { return strategy ? &*strategy : nullptr; }
};

std::vector<Unproved> WithoutConditions(const std::vector<std::string>& absorbed,
                                        std::vector<Unproved> unproved) {
  std::erase_if(unproved, [&](const Unproved& unmet) {
    return std::ranges::count(absorbed, unmet.claim.condition) > 0;
  });
  return unproved;
}

std::vector<Unproved> Unabsorbed(const Entry& entry, std::vector<Unproved> unproved) {
  return WithoutConditions(entry.absorbed, std::move(unproved));
}

std::vector<algebra::Expression> ExpressionsOf(const std::vector<Unproved>& goals) {
  std::vector<algebra::Expression> expressions;
  for (const Unproved& goal : goals) expressions.push_back(goal.expression);
  return expressions;
}

std::string WhyUnproved(const plan::CertifiedPrecondition& claim) {
  const bool less = claim.relation == plan::Relation::kLess;
  const bool is_angle = claim.condition == "tilt" || claim.condition == "tip turn";
  const bool is_ratio = plan::IsRatio(claim.condition);
  const double scale = is_ratio ? 1 : is_angle ? 180 / std::numbers::pi : 1000;
  return fmt::format("not proved that {}: {} {:.4g}, must be {} {:.4g}{}", claim.meaning,
                     less ? "SUP" : "INF", scale * claim.bound, less ? "<" : ">",
                     scale * claim.limit,
                     is_ratio   ? ""
                     : is_angle ? " deg"
                                : " mm");
}

enum class Absorbing { kNo, kYes };

struct Candidate {
  int resolver = 0;  // index in the options
  Remedy remedy;
};

// What is known as plan instances are executed, one way and another.
struct Worlds {
  Worlds(const domain::Problem& problem, const UncertaintyOptions& options)
      : possible(problem, options.propagation, options.bound) {
    if (BestKnown::Bounds(problem, options.propagation)) {
      best.emplace(problem, options.propagation, options.bound);
    }
  }

  WorldTree possible;
  std::optional<BestKnown> best;  // where it bounds what remedies can reach
};

// Conditions that some remedy may absorb.
std::vector<std::string> Absorbable(const UncertaintyOptions& options) {
  std::vector<std::string> conditions;
  for (const auto& resolver : options.resolvers) {
    std::ranges::move(resolver->absorbs(), std::back_inserter(conditions));
  }
  return conditions;
}

// How an augmented plan instance compares with others; less is better.
struct Standing {
  int errors = 0;
  std::size_t actions = 0;  // of the first phase
  double violation = 0;     // metres and radians

  auto operator<=>(const Standing&) const = default;
};

// Decides only what is proved; the certificates are written for the instance that is kept.
class Augmentation {
 public:
  Augmentation(const domain::Problem& problem, const plan::Plan& instance,
               const UncertaintyOptions& options, Worlds& worlds)
      : problem_(problem), instance_(instance), options_(options), worlds_(worlds) {
    for (const plan::Sense& look : options.looks) {
      entries_.push_back(
          {.id = plan::StepId(instance.steps.size() + entries_.size()), .action = look});
    }
    for (const plan::StepId id : instance.ExecutionOrder()) {
      entries_.push_back({.id = id, .action = instance.step(id).action});
    }
    while (!DecideInOrder()) {
    }
  }

  std::int64_t combinations() const { return combinations_; }
  int errors() const { return static_cast<int>(std::ranges::count_if(entries_, Fails)); }
  Standing standing() const { return {errors(), instance_.steps.size(), violation()}; }

  AugmentedPlanInstance WriteOut() const {
    AugmentedPlanInstance augmented = {
        .plan = instance_, .violation = violation(), .combinations = combinations_};
    plan::Plan& plan = augmented.plan;
    plan.errors = errors();
    plan.steps.resize(entries_.size());
    UncertainWorld world(problem_, options_.propagation);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      WriteOut(entries_[i], static_cast<int>(i) + 1, world, plan);
    }
    if (entries_.size() > instance_.steps.size()) plan.ordering = OrderOfExecution();
    return augmented;
  }

 private:
  struct Mended {
    std::vector<Entry> entries;
    int step = 0;  // where the mended step is now
  };

  static bool Fails(const Entry& entry) { return !entry.failed.IsNone(); }

  double violation() const {
    double violation = 0;
    for (const Entry& entry : entries_) {
      if (!Fails(entry)) continue;
      violation +=
          ShortfallOf(Unabsorbed(entry, worlds_.possible.UnprovedAt(entry.failed))).violation;
    }
    return violation;
  }

  // False if a remedy was inserted, so that all must be decided anew.
  bool DecideInOrder() {
    MomentId moment = worlds_.possible.Beginning();
    for (int i = 0; i < std::ssize(entries_); ++i) {
      moment = After(worlds_.possible, moment, entries_[i]);
      entries_[i].failed = MomentId::None();
      if (Unabsorbed(entries_[i], worlds_.possible.UnprovedAt(moment)).empty()) continue;
      if (!entries_[i].given_up && Mend(i, {moment, entries_[i].absorbed})) return false;
      entries_[i].failed = moment;
    }
    return true;
  }

  static MomentId After(WorldTree& tree, MomentId before, const Entry& entry) {
    return tree.After(before, entry.action, entry.way());
  }

  static bool IsProved(WorldTree& tree, MomentId after, const Entry& entry) {
    if (entry.absorbed.empty()) return tree.IsProved(after);
    return Unabsorbed(entry, tree.UnprovedAt(after)).empty();
  }

  std::vector<Unproved> UnprovedGoals(const Unmet& unmet) const {
    return WithoutConditions(unmet.absorbed, worlds_.possible.UnprovedAt(unmet.after));
  }

  // The goal that fails by most, as the certificate will tell it.
  std::string Why(const Unmet& unmet) const {
    const std::vector<Unproved> unproved = UnprovedGoals(unmet);
    const auto margin = [](const Unproved& goal) { return goal.claim.margin; };
    const Unproved& worst = *std::ranges::min_element(unproved, {}, margin);
    return WhyUnproved(worlds_.possible.Told(unmet.after, worst).claim);
  }

  CertifiedStep Certify(UncertainWorld& world, const Entry& entry) const {
    CertifiedStep step = CertifyStep(world, entry.action, options_.bound, entry.way());
    step.unproved = Unabsorbed(entry, std::move(step.unproved));
    return step;
  }

  // Whether remedies were applied. If none prove all the step's goals, the step is given up, and
  // only what brings them nearest without moving parts is applied. Strategies take long to find,
  // and are asked for where nothing else proves the goals.
  bool Mend(int step, const Unmet& unmet) {
    const auto apply = [&](Mended mended) {
      entries_ = std::move(mended.entries);
      return mended.step;
    };
    std::vector<Candidate> candidates = Candidates(step, unmet, Absorbing::kNo);
    std::optional<Mended> proving;
    if (MayBeProved(step, {})) proving = ProvingRemedies(step, candidates, unmet, Absorbing::kNo);
    if (!proving && MayBeProved(step, Absorbable(options_))) {
      std::ranges::move(Candidates(step, unmet, Absorbing::kYes), std::back_inserter(candidates));
      std::ranges::stable_sort(candidates, {}, &Candidate::resolver);
      proving = ProvingRemedies(step, candidates, unmet, Absorbing::kYes);
    }
    if (proving) {
      NoteWhatFellShort(step, candidates, unmet, proving->entries[proving->step]);
      apply(std::move(*proving));
      return true;
    }
    auto nearer = NearingRemedies(step, candidates, unmet);
    const bool helps = nearer.has_value();
    if (nearer) step = apply(std::move(*nearer));
    GiveUp(entries_[step], unmet);
    return helps;
  }

  // Not if other goals of the step than those that remedies absorb fail even when all is known that
  // they could tell: then trying them one by one is of no use.
  bool MayBeProved(int step, std::vector<std::string> absorbable) const {
    if (!worlds_.best) return true;
    MomentId moment = worlds_.best->Beginning();
    for (int i = 0; i <= step; ++i) {
      const Entry& entry = entries_[i];
      if (!IsInserted(entry)) moment = worlds_.best->After(moment, entry.action, entry.way());
    }
    const std::vector<std::string>& absorbed = entries_[step].absorbed;
    absorbable.insert(absorbable.end(), absorbed.begin(), absorbed.end());
    return worlds_.best->LeastShortfall(moment, absorbable).goals == 0;
  }

  bool IsInserted(const Entry& entry) const {
    return entry.id.index() >= static_cast<int>(instance_.steps.size());
  }

  // Of the combinations with a candidate that may absorb errors, or of those without.
  std::optional<Mended> ProvingRemedies(int step, const std::vector<Candidate>& candidates,
                                        const Unmet& unmet, Absorbing absorbing) {
    const std::vector<Combinable> items = ItemsOf(candidates);
    std::optional<Mended> proving;
    const auto proves = [&](const std::vector<int>& chosen) {
      const bool may_absorb = std::ranges::any_of(
          chosen, [&](int c) { return !options_.resolvers[items[c].group]->absorbs().empty(); });
      if (may_absorb != (absorbing == Absorbing::kYes)) return false;
      ++combinations_;
      Mended mended = With(step, candidates, chosen, unmet);
      if (!IsProved(mended)) return false;
      proving = std::move(mended);
      return true;
    };
    VisitCombinations(items, options_.most_remedies, options_.combinations, proves);
    return proving;
  }

  std::optional<Mended> NearingRemedies(int step, const std::vector<Candidate>& candidates,
                                        const Unmet& unmet) {
    std::optional<Mended> nearest;
    std::optional<Shortfall> least = ShortfallAfter({entries_, step});
    std::vector<Combinable> items = ItemsOf(candidates);
    std::erase_if(
        items, [&](const Combinable& item) { return options_.resolvers[item.group]->disturbs(); });
    const auto compare = [&](const std::vector<int>& chosen) {
      Mended mended = With(step, candidates, chosen, unmet);
      const std::optional<Shortfall> shortfall = ShortfallAfter(mended);
      if (!shortfall || !shortfall->IsLessThan(*least)) return false;
      least = shortfall;
      nearest = std::move(mended);
      return false;
    };
    VisitCombinations(items, options_.most_remedies, options_.combinations, compare);
    return nearest;
  }

  // Adds to the reasons for moving parts why it did not do without.
  void NoteWhatFellShort(int step, const std::vector<Candidate>& candidates, const Unmet& unmet,
                         Entry& mended) {
    const auto disturbs = [&](const Measure& measure) {
      const auto resolver = std::ranges::find(
          options_.resolvers, measure.resolver,
          [](const std::shared_ptr<Resolver>& r) { return std::string(r->name()); });
      return resolver != options_.resolvers.end() && (*resolver)->disturbs();
    };
    if (std::ranges::none_of(mended.measures, disturbs)) return;
    const std::optional<Mended> nearest = NearingRemedies(step, candidates, unmet);
    if (!nearest) return;
    const Entry& entry = nearest->entries[nearest->step];
    const MomentId after = MomentAfter(*nearest);
    if (Unabsorbed(entry, worlds_.possible.UnprovedAt(after)).empty()) return;
    for (Measure& measure : mended.measures) {
      if (!disturbs(measure) || measure.because != unmet) continue;
      measure.without_moving = {entry.measures.back().resolver, {after, entry.absorbed}};
    }
  }

  static std::vector<Combinable> ItemsOf(const std::vector<Candidate>& candidates) {
    std::vector<Combinable> items;
    for (const Candidate& candidate : candidates) {
      items.push_back({candidate.resolver, candidate.remedy.part.index()});
    }
    return items;
  }

  // Of the resolvers that may absorb errors, or of the others.
  std::vector<Candidate> Candidates(int step, const Unmet& failed, Absorbing absorbing) const {
    std::vector<plan::Action> actions;
    std::vector<std::optional<plan::Strategy>> strategies;
    for (const Entry& entry : entries_) {
      actions.push_back(entry.action);
      strategies.push_back(entry.strategy);
    }
    UnmetGoals unmet = {problem_, actions, step, UnprovedGoals(failed), {}, std::move(strategies)};
    unmet.parts = worlds_.possible.WorldAt(failed.after).PartsIn(ExpressionsOf(unmet.goals));
    std::vector<Candidate> candidates;
    for (std::size_t r = 0; r < options_.resolvers.size(); ++r) {
      if (options_.resolvers[r]->absorbs().empty() == (absorbing == Absorbing::kYes)) continue;
      for (Remedy& remedy : options_.resolvers[r]->Propose(unmet)) {
        candidates.push_back({static_cast<int>(r), std::move(remedy)});
      }
    }
    return candidates;
  }

  // The entries with the chosen remedies for a step applied.
  Mended With(int step, const std::vector<Candidate>& candidates, const std::vector<int>& chosen,
              const Unmet& unmet) const {
    Mended mended;
    Entry target = entries_[step];
    int next_id = static_cast<int>(entries_.size());
    for (int position = 0; position < static_cast<int>(entries_.size()); ++position) {
      for (const int c : chosen) {
        for (const Insertion& insertion : candidates[c].remedy.insertions) {
          if (insertion.before != position) continue;
          const plan::StepId id(next_id++);
          mended.entries.push_back({.id = id, .action = insertion.action});
          Note(target, NameOf(candidates[c]), unmet).steps.push_back(id);
        }
      }
      if (position == step) mended.step = static_cast<int>(mended.entries.size());
      mended.entries.push_back(entries_[position]);
    }
    for (const int c : chosen) {
      const Remedy& remedy = candidates[c].remedy;
      target.absorbed.insert(target.absorbed.end(), remedy.absorbs.begin(), remedy.absorbs.end());
      if (remedy.strategy) target.strategy = remedy.strategy;
      Note(target, NameOf(candidates[c]), unmet);
    }
    mended.entries[mended.step] = std::move(target);
    return mended;
  }

  std::string NameOf(const Candidate& candidate) const {
    return std::string(options_.resolvers[candidate.resolver]->name());
  }

  // The entry's measure by this resolver, a new one if there is none.
  static Measure& Note(Entry& entry, const std::string& resolver, const Unmet& unmet) {
    const auto known = std::ranges::find(entry.measures, resolver, &Measure::resolver);
    if (known != entry.measures.end()) return *known;
    return entry.measures.emplace_back(Measure{.resolver = resolver, .because = unmet});
  }

  bool IsProved(const Mended& mended) const {
    return IsReached(mended) &&
           IsProved(worlds_.possible, MomentAfter(mended), mended.entries[mended.step]);
  }

  // None if the mended step is not reached.
  std::optional<Shortfall> ShortfallAfter(const Mended& mended) const {
    if (!IsReached(mended)) return std::nullopt;
    const std::vector<Unproved>& unproved = worlds_.possible.UnprovedAt(MomentAfter(mended));
    return ShortfallOf(Unabsorbed(mended.entries[mended.step], unproved));
  }

  // Unless a new step up to the mended one, or one after it, is not proved and was not given up.
  bool IsReached(const Mended& mended) const {
    MomentId moment = worlds_.possible.Beginning();
    bool is_changed = false;
    for (int i = 0; i < mended.step; ++i) {
      const Entry& entry = mended.entries[i];
      moment = After(worlds_.possible, moment, entry);
      is_changed |= entry.id.index() >= static_cast<int>(entries_.size());
      if (is_changed && !entry.given_up && !IsProved(worlds_.possible, moment, entry)) return false;
    }
    return true;
  }

  MomentId MomentAfter(const Mended& mended) const {
    MomentId moment = worlds_.possible.Beginning();
    for (int i = 0; i <= mended.step; ++i) {
      moment = After(worlds_.possible, moment, mended.entries[i]);
    }
    return moment;
  }

  static void GiveUp(Entry& entry, const Unmet& unmet) {
    entry.given_up = true;
    entry.strategy.reset();
    entry.absorbed.clear();
    Note(entry, "verification", unmet);
  }

  Resolution InWords(const Measure& measure) const {
    Resolution resolution = {
        .resolver = measure.resolver, .steps = measure.steps, .why = Why(measure.because)};
    if (const auto& less = measure.without_moving) {
      resolution.why += fmt::format("; after {} still {}", less->resolver, Why(less->still));
    }
    return resolution;
  }

  void WriteOut(const Entry& entry, int executed, UncertainWorld& world, plan::Plan& plan) const {
    plan::PlannedStep& step = plan.steps[entry.id.index()];
    if (IsInserted(entry)) {
      step.name = fmt::format("action_{}", entry.id.index() + 1);
      step.action = entry.action;
      step.inserted = entry.id.index() + 1;
    }
    step.executed = executed;
    step.strategy = entry.strategy;
    CertifiedStep certified = Certify(world, entry);
    ASSAY_CHECK(certified.unproved.empty() == !Fails(entry),
                "'{}' is certified otherwise than it was decided", step.name);
    step.certificate = std::move(certified.certificate);
    for (const Measure& measure : entry.measures) {
      step.certificate.resolutions.push_back(InWords(measure));
    }
    if (Fails(entry)) AddVerification(problem_, entry.id, step.action, step.certificate, plan);
  }

  // What was inserted was certified for this order.
  std::vector<std::pair<plan::StepId, plan::StepId>> OrderOfExecution() const {
    std::vector<std::pair<plan::StepId, plan::StepId>> ordering;
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      ordering.emplace_back(entries_[i - 1].id, entries_[i].id);
    }
    return ordering;
  }

  const domain::Problem& problem_;
  const plan::Plan instance_;
  const UncertaintyOptions& options_;
  Worlds& worlds_;
  std::vector<Entry> entries_;  // in the order of execution
  std::int64_t combinations_ = 0;
};

// That no remedies can better.
Standing LeastStanding(const plan::Plan& instance, const UncertaintyOptions& options,
                       Worlds& worlds) {
  Standing least = {.actions = instance.steps.size()};
  if (!worlds.best) return least;
  const std::vector<std::string> absorbable = Absorbable(options);
  MomentId moment = worlds.best->Beginning();
  for (const plan::StepId id : instance.ExecutionOrder()) {
    moment = worlds.best->After(moment, instance.step(id).action, nullptr);
    const Shortfall shortfall = worlds.best->LeastShortfall(moment, absorbable);
    least.errors += shortfall.goals > 0 ? 1 : 0;
    least.violation += shortfall.violation;
  }
  return least;
}

// A hand turned by half a turn grasps as well: one of the two is enough.
bool IsAsGood(const Standing& a, const Standing& b) {
  constexpr double kSameViolation = 1e-6;
  return a.errors == b.errors && a.actions == b.actions &&
         std::abs(a.violation - b.violation) < kSameViolation;
}

// The best of the plan instances that were augmented. Instances of which it is known beforehand
// that not all can be proved wait until all are there: then those are augmented that could still
// come first, the most promising first, one of those that promise the same.
class BestInstance {
 public:
  BestInstance(const domain::Problem& problem, const UncertaintyOptions& options)
      : problem_(problem),
        options_(options),
        worlds_(problem, options),
        for_violation_(options.instances_for_violation) {}

  void Consider(const plan::Plan& instance) {
    const Standing least = LeastStanding(instance, options_, worlds_);
    if (least.errors > 0) {
      waiting_.push_back({least, instance});
    } else {
      TakeIfBetter(instance);
    }
  }
  void ConsiderWaiting() {
    std::ranges::stable_sort(waiting_, {}, &Waiting::least);
    std::optional<Standing> promised;
    for (const auto& [least, instance] : waiting_) {
      if (promised && IsAsGood(*promised, least)) continue;
      if (!IsWorthAugmenting(least)) continue;
      promised = least;
      TakeIfBetter(instance);
    }
    waiting_.clear();
  }

  // Null before the first.
  const Augmentation* get() const { return best_.get(); }
  bool is_proved() const { return best_ && best_->errors() == 0; }
  std::int64_t combinations() const { return combinations_; }  // of remedies that were tried

 private:
  struct Waiting {
    Standing least;
    plan::Plan instance;
  };

  // Whether it might come before the best one; few of those that might do so by their violation
  // alone.
  bool IsWorthAugmenting(const Standing& least) {
    if (!best_) return true;
    const Standing best = best_->standing();
    if (!(least < best)) return false;
    const bool may_have_fewer =
        std::tie(least.errors, least.actions) < std::tie(best.errors, best.actions);
    return may_have_fewer || for_violation_-- > 0;
  }

  void TakeIfBetter(const plan::Plan& instance) {
    auto augmentation = std::make_unique<const Augmentation>(problem_, instance, options_, worlds_);
    combinations_ += augmentation->combinations();
    if (!best_ || augmentation->standing() < best_->standing()) best_ = std::move(augmentation);
  }

  const domain::Problem& problem_;
  const UncertaintyOptions& options_;
  Worlds worlds_;
  std::int64_t for_violation_;  // that are still to be augmented
  std::vector<Waiting> waiting_;
  std::unique_ptr<const Augmentation> best_;
  std::int64_t combinations_ = 0;
};

UncertaintyOptions WithDefaults(UncertaintyOptions options) {
  if (options.resolvers.empty()) {
    options.resolvers = {std::make_shared<SensingResolver>(),
                         std::make_shared<SqueezingResolver>()};
  }
  return options;
}

}  // namespace

AugmentedPlanInstance Augment(const domain::Problem& problem, const plan::Plan& instance,
                              const UncertaintyOptions& options) {
  const UncertaintyOptions complete = WithDefaults(options);
  Worlds worlds(problem, complete);
  return Augmentation(problem, instance, complete, worlds).WriteOut();
}

plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem, const PlannerOptions& planner,
                                   const UncertaintyOptions& options) {
  ASSAY_CHECK(!planner.accept, "which instance is accepted is for the uncertainty phase to say");
  const UncertaintyOptions complete = WithDefaults(options);
  BestInstance best(problem, complete);
  std::int64_t instances = 0;
  PlannerOptions first_phase = planner;
  first_phase.accept = [&](const plan::Plan& instance) {
    if (!complete.can_be_executed || complete.can_be_executed(instance)) best.Consider(instance);
    return best.is_proved() || ++instances >= complete.instances;
  };
  plan::PlanResult result = MakePlan(problem, first_phase);
  if (!best.is_proved()) best.ConsiderWaiting();
  result.counters["remedies"] = best.combinations();
  if (best.get() != nullptr) {
    result.outcome = Outcome::kFound;
    result.conflict.clear();
    result.plan = best.get()->WriteOut().plan;
  } else if (instances > 0) {  // none of which can be executed
    result.outcome = Outcome::kBudget;
    result.plan = {};
    result.conflict.clear();
  }
  return result;
}

}  // namespace assay::posting
