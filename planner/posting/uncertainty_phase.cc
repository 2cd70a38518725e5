#include "planner/posting/uncertainty_phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

#include "planner/base/check.h"
#include "planner/plan/condition_kind.h"
#include "planner/plan/linearization.h"
#include "planner/posting/best_known.h"
#include "planner/posting/combinations.h"
#include "planner/posting/instance.h"
#include "planner/posting/sensing_resolver.h"
#include "planner/posting/squeezing_resolver.h"
#include "planner/posting/verification.h"
#include "planner/uncertainty/world_tree.h"

namespace assay::posting {

using domain::PartId;
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

// Whether a goal may be proved with the same grasp and the same side up elsewhere on the table.
bool DependsOnPlace(const Unproved& goal) {
  return !goal.neighbour.IsNone() || goal.claim.condition == "footprint";
}

struct HandledParts {
  const domain::Problem& problem;

  std::vector<PartId> operator()(const plan::Assemble& assemble) const {
    const domain::Mating& mating = problem.mating(assemble.mating);
    return {mating.held, mating.fixed};
  }
  std::vector<PartId> operator()(const auto& action) const { return {action.part}; }
};

// What an action is about, in whatever plan.
struct Subject {
  std::size_t kind = 0;  // index of the action's kind
  std::vector<PartId> parts = {};

  bool operator==(const Subject&) const = default;
};
Subject SubjectOf(const domain::Problem& problem, const plan::Action& action) {
  return {action.index(), std::visit(HandledParts{problem}, action)};
}

std::vector<algebra::Expression> ExpressionsOf(const std::vector<Unproved>& goals) {
  std::vector<algebra::Expression> expressions;
  for (const Unproved& goal : goals) expressions.push_back(goal.expression);
  return expressions;
}

std::string WhyUnproved(const plan::CertifiedPrecondition& claim) {
  const bool less = claim.relation == plan::Relation::kLess;
  const plan::Quantity quantity = plan::QuantityOf(claim.condition);
  const bool is_angle = quantity == plan::Quantity::kAngle;
  const bool is_ratio = quantity == plan::Quantity::kRatio;
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

  std::int64_t moments() const { return possible.size() + (best ? best->moments() : 0); }
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

// What is done about a step that cannot be proved.
enum class IfUnproved {
  kPrepare,       // it is brought nearer to being proved, and its failure is prepared for
  kObject,        // nothing: it is only told why
  kObjectAtOnce,  // and remedies are not even tried where it matters where parts are
};

// Steps of a plan instance with what is inserted, one after another in the order of execution.
// Decides only what is proved; the certificates are written for the instance that is kept.
class Augmentation {
 public:
  // No step yet, of an instance of so many.
  Augmentation(const domain::Problem& problem, std::size_t steps, const UncertaintyOptions& options,
               Worlds& worlds)
      : problem_(&problem), steps_(steps), options_(&options), worlds_(&worlds) {
    for (const plan::Sense& look : options.looks) {
      entries_.push_back({.id = plan::StepId(NextId()), .action = look});
    }
  }
  // Of a whole instance.
  Augmentation(const domain::Problem& problem, const plan::Plan& instance,
               const UncertaintyOptions& options, Worlds& worlds)
      : Augmentation(problem, instance.steps.size(), options, worlds) {
    for (const plan::StepId id : instance.ExecutionOrder()) {
      Add(id, instance.step(id).action, IfUnproved::kPrepare);
    }
  }

  // Whether all goals of the step are proved, with what is then inserted.
  bool Add(plan::StepId id, const plan::Action& action, IfUnproved if_unproved) {
    if_unproved_ = if_unproved;
    entries_.push_back({.id = id, .action = action});
    while (!DecideInOrder()) {
    }
    return !Fails(entries_.back());
  }

  // To the step that was added last, which is not proved. If it fails even with the best known, by
  // what fails then; and if of that not all depends on where parts are, by the rest.
  Objection ObjectionToLast() const {
    const int step = static_cast<int>(entries_.size()) - 1;
    const auto unmet = UnmetWhateverIsKnown(step);
    const UncertainWorld& world = unmet.empty() ? worlds_->possible.WorldAt(entries_[step].failed)
                                                : worlds_->best->WorldAt(BestMoment(step));
    Objection objection = {.action = step - InsertedBefore(step),
                           .parts = std::visit(HandledParts{*problem_}, entries_[step].action),
                           .history = unmet.empty()};
    Explain(unmet.empty() ? GoalsUnproved(step) : unmet, world, objection);
    if (unmet.empty()) AddObstaclesOfRemedies(objection);
    return objection;
  }

  // What the steps are about that are not proved wherever parts are.
  std::vector<Subject> FailingAnywhere() const {
    std::vector<Subject> failing;
    for (int i = 0; i < std::ssize(entries_); ++i) {
      if (!Fails(entries_[i]) || std::ranges::any_of(GoalsUnproved(i), DependsOnPlace)) continue;
      failing.push_back(SubjectOf(*problem_, entries_[i].action));
    }
    return failing;
  }

  std::int64_t combinations() const { return combinations_; }
  int errors() const { return static_cast<int>(std::ranges::count_if(entries_, Fails)); }
  Standing standing() const { return {errors(), steps_, violation()}; }

  // The instance, which is that of all steps that were added.
  AugmentedPlanInstance WriteOut(const plan::Plan& instance) const {
    AugmentedPlanInstance augmented = {
        .plan = instance, .violation = violation(), .combinations = combinations_};
    plan::Plan& plan = augmented.plan;
    plan.errors = errors();
    plan.steps.resize(entries_.size());
    UncertainWorld world(*problem_, options_->propagation);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      WriteOut(entries_[i], static_cast<int>(i) + 1, world, plan);
    }
    if (!IsProvedInEveryOrder(instance)) plan.ordering = OrderOfExecution();
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
          ShortfallOf(Unabsorbed(entry, worlds_->possible.UnprovedAt(entry.failed))).violation;
    }
    return violation;
  }

  // False if a remedy was inserted, so that all must be decided anew.
  bool DecideInOrder() {
    MomentId moment = worlds_->possible.Beginning();
    for (int i = 0; i < std::ssize(entries_); ++i) {
      moment = After(worlds_->possible, moment, entries_[i]);
      entries_[i].failed = MomentId::None();
      if (Unabsorbed(entries_[i], worlds_->possible.UnprovedAt(moment)).empty()) continue;
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
    return WithoutConditions(unmet.absorbed, worlds_->possible.UnprovedAt(unmet.after));
  }

  // The goal that fails by most, as the certificate will tell it.
  std::string Why(const Unmet& unmet) const {
    const std::vector<Unproved> unproved = UnprovedGoals(unmet);
    const auto margin = [](const Unproved& goal) { return goal.claim.margin; };
    const Unproved& worst = *std::ranges::min_element(unproved, {}, margin);
    return WhyUnproved(worlds_->possible.Told(unmet.after, worst).claim);
  }

  CertifiedStep Certify(UncertainWorld& world, const Entry& entry) const {
    CertifiedStep step = CertifyStep(world, entry.action, options_->bound, entry.way());
    step.unproved = Unabsorbed(entry, std::move(step.unproved));
    return step;
  }

  // Whether remedies were applied. If none prove all the step's goals, the step is given up, and
  // only what brings them nearest without moving parts is applied. Strategies take long to find,
  // and are asked for where nothing else proves the goals.
  bool Mend(int step, const Unmet& unmet) {
    obstacles_.clear();
    if (if_unproved_ == IfUnproved::kObjectAtOnce &&
        std::ranges::any_of(UnprovedGoals(unmet), DependsOnPlace)) {
      GiveUp(entries_[step], unmet);
      return false;
    }
    const auto apply = [&](Mended mended) {
      entries_ = std::move(mended.entries);
      return mended.step;
    };
    std::vector<Candidate> candidates = Candidates(step, unmet, Absorbing::kNo);
    std::optional<Mended> proving;
    if (MayBeProved(step, {})) proving = ProvingRemedies(step, candidates, unmet, Absorbing::kNo);
    if (!proving && MayBeProved(step, Absorbable(*options_))) {
      std::ranges::move(Candidates(step, unmet, Absorbing::kYes), std::back_inserter(candidates));
      std::ranges::stable_sort(candidates, {}, &Candidate::resolver);
      proving = ProvingRemedies(step, candidates, unmet, Absorbing::kYes);
    }
    if (proving) {
      NoteWhatFellShort(step, candidates, unmet, proving->entries[proving->step]);
      apply(std::move(*proving));
      return true;
    }
    if (if_unproved_ != IfUnproved::kPrepare) {
      GiveUp(entries_[step], unmet);
      return false;
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
    if (!worlds_->best) return true;
    const std::vector<std::string>& absorbed = entries_[step].absorbed;
    absorbable.insert(absorbable.end(), absorbed.begin(), absorbed.end());
    return worlds_->best->LeastShortfall(BestMoment(step), absorbable).goals == 0;
  }

  // After the step, with the best known.
  MomentId BestMoment(int step) const {
    MomentId moment = worlds_->best->Beginning();
    for (int i = 0; i <= step; ++i) {
      const Entry& entry = entries_[i];
      if (!IsInserted(entry)) moment = worlds_->best->After(moment, entry.action, entry.way());
    }
    return moment;
  }

  // Goals of a step that fail whatever remedies tell; of these, if there are any, those that fail
  // wherever parts are. Empty if remedies may do.
  std::vector<Unproved> UnmetWhateverIsKnown(int step) const {
    if (!worlds_->best) return {};
    std::vector<Unproved> unmet =
        worlds_->best->UnprovedAt(BestMoment(step), Absorbable(*options_));
    if (!std::ranges::all_of(unmet, DependsOnPlace)) std::erase_if(unmet, DependsOnPlace);
    return unmet;
  }

  std::vector<Unproved> GoalsUnproved(int step) const {
    const Entry& entry = entries_[step];
    return Unabsorbed(entry, worlds_->possible.UnprovedAt(entry.failed));
  }

  int InsertedBefore(int step) const {
    return static_cast<int>(std::count_if(entries_.begin(), entries_.begin() + step,
                                          [&](const Entry& entry) { return IsInserted(entry); }));
  }

  // What the goals say of the objection, the one that is missed by most first.
  static void Explain(std::vector<Unproved> goals, const UncertainWorld& world,
                      Objection& objection) {
    std::ranges::stable_sort(goals, {}, [](const Unproved& goal) { return goal.claim.margin; });
    objection.why = WhyUnproved(goals.front().claim);
    objection.place = std::ranges::all_of(goals, DependsOnPlace);
    for (const PartId part : world.PartsIn(ExpressionsOf(goals))) AddTo(objection.parts, part);
    if (!objection.place) return;  // it fails were nothing else there
    for (const Unproved& goal : goals) {
      if (!goal.neighbour.IsNone()) AddInTheWay(goal.neighbour, WhyUnproved(goal.claim), objection);
    }
  }

  static void AddTo(std::vector<PartId>& parts, PartId part) {
    if (std::ranges::count(parts, part) == 0) parts.push_back(part);
  }
  static void AddInTheWay(PartId part, std::string why, Objection& objection) {
    const auto is_known = std::ranges::count(objection.in_the_way, part, &PartInTheWay::part) > 0;
    if (!is_known) objection.in_the_way.push_back({part, std::move(why)});
  }

  // Parts beside which remedies cannot be executed, or not be proved.
  void AddObstaclesOfRemedies(Objection& objection) const {
    for (const PartId part : obstacles_) {
      if (std::ranges::count(objection.parts, part) > 0) continue;
      AddInTheWay(part, objection.why, objection);
      objection.place = true;
    }
  }

  bool IsInserted(const Entry& entry) const { return entry.id.index() >= static_cast<int>(steps_); }
  // Of the step that is inserted next.
  int NextId() const {
    const auto inserted =
        std::ranges::count_if(entries_, [&](const Entry& entry) { return IsInserted(entry); });
    return static_cast<int>(steps_ + inserted);
  }

  // Of the combinations with a candidate that may absorb errors, or of those without.
  std::optional<Mended> ProvingRemedies(int step, const std::vector<Candidate>& candidates,
                                        const Unmet& unmet, Absorbing absorbing) {
    const std::vector<Combinable> items = ItemsOf(candidates);
    std::optional<Mended> proving;
    const auto proves = [&](const std::vector<int>& chosen) {
      const bool may_absorb = std::ranges::any_of(
          chosen, [&](int c) { return !options_->resolvers[items[c].group]->absorbs().empty(); });
      if (may_absorb != (absorbing == Absorbing::kYes)) return false;
      ++combinations_;
      Mended mended = With(step, candidates, chosen, unmet);
      if (const auto unproved = FirstUnproved(mended)) {
        NoteNeighbours(unproved->after);
        return false;
      }
      proving = std::move(mended);
      return true;
    };
    VisitCombinations(items, options_->most_remedies, options_->combinations, proves);
    return proving;
  }

  std::optional<Mended> NearingRemedies(int step, const std::vector<Candidate>& candidates,
                                        const Unmet& unmet) {
    std::optional<Mended> nearest;
    std::optional<Shortfall> least = ShortfallAfter({entries_, step});
    std::vector<Combinable> items = ItemsOf(candidates);
    std::erase_if(
        items, [&](const Combinable& item) { return options_->resolvers[item.group]->disturbs(); });
    const auto compare = [&](const std::vector<int>& chosen) {
      Mended mended = With(step, candidates, chosen, unmet);
      const std::optional<Shortfall> shortfall = ShortfallAfter(mended);
      if (!shortfall || !shortfall->IsLessThan(*least)) return false;
      least = shortfall;
      nearest = std::move(mended);
      return false;
    };
    VisitCombinations(items, options_->most_remedies, options_->combinations, compare);
    return nearest;
  }

  // Adds to the reasons for moving parts why it did not do without.
  void NoteWhatFellShort(int step, const std::vector<Candidate>& candidates, const Unmet& unmet,
                         Entry& mended) {
    const auto disturbs = [&](const Measure& measure) {
      const auto resolver = std::ranges::find(
          options_->resolvers, measure.resolver,
          [](const std::shared_ptr<Resolver>& r) { return std::string(r->name()); });
      return resolver != options_->resolvers.end() && (*resolver)->disturbs();
    };
    if (std::ranges::none_of(mended.measures, disturbs)) return;
    const std::optional<Mended> nearest = NearingRemedies(step, candidates, unmet);
    if (!nearest) return;
    const Entry& entry = nearest->entries[nearest->step];
    const MomentId after = MomentAfter(*nearest);
    if (Unabsorbed(entry, worlds_->possible.UnprovedAt(after)).empty()) return;
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
  std::vector<Candidate> Candidates(int step, const Unmet& failed, Absorbing absorbing) {
    std::vector<plan::Action> actions;
    std::vector<std::optional<plan::Strategy>> strategies;
    for (const Entry& entry : entries_) {
      actions.push_back(entry.action);
      strategies.push_back(entry.strategy);
    }
    UnmetGoals unmet = {*problem_, actions, step, UnprovedGoals(failed), {}, std::move(strategies)};
    unmet.parts = worlds_->possible.WorldAt(failed.after).PartsIn(ExpressionsOf(unmet.goals));
    std::vector<Candidate> candidates;
    for (std::size_t r = 0; r < options_->resolvers.size(); ++r) {
      if (options_->resolvers[r]->absorbs().empty() == (absorbing == Absorbing::kYes)) continue;
      for (Remedy& remedy : options_->resolvers[r]->Propose(unmet)) {
        candidates.push_back({static_cast<int>(r), std::move(remedy)});
      }
      if (if_unproved_ == IfUnproved::kPrepare) continue;
      for (const PartId part : options_->resolvers[r]->Obstacles(unmet)) obstacles_.insert(part);
    }
    return candidates;
  }

  // The entries with the chosen remedies for a step applied.
  Mended With(int step, const std::vector<Candidate>& candidates, const std::vector<int>& chosen,
              const Unmet& unmet) const {
    Mended mended;
    Entry target = entries_[step];
    int next_id = NextId();
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
    return std::string(options_->resolvers[candidate.resolver]->name());
  }

  // The entry's measure by this resolver, a new one if there is none.
  static Measure& Note(Entry& entry, const std::string& resolver, const Unmet& unmet) {
    const auto known = std::ranges::find(entry.measures, resolver, &Measure::resolver);
    if (known != entry.measures.end()) return *known;
    return entry.measures.emplace_back(Measure{.resolver = resolver, .because = unmet});
  }

  // The first of the new steps up to the mended one, and of those after one, that is not proved and
  // was not given up; or else the mended step, if it is not proved.
  struct UnprovedStep {
    int step = 0;
    MomentId after;
  };
  std::optional<UnprovedStep> FirstUnproved(const Mended& mended) const {
    MomentId moment = worlds_->possible.Beginning();
    bool is_changed = false;
    const int next_id = NextId();
    for (int i = 0; i <= mended.step; ++i) {
      const Entry& entry = mended.entries[i];
      moment = After(worlds_->possible, moment, entry);
      is_changed |= entry.id.index() >= next_id;
      const bool must_be_proved = i == mended.step || (is_changed && !entry.given_up);
      if (must_be_proved && !IsProved(worlds_->possible, moment, entry)) return {{i, moment}};
    }
    return std::nullopt;
  }

  // None if the mended step is not reached.
  std::optional<Shortfall> ShortfallAfter(const Mended& mended) const {
    const auto unproved = FirstUnproved(mended);
    if (!unproved) return Shortfall{};
    if (unproved->step < mended.step) return std::nullopt;
    return ShortfallOf(
        Unabsorbed(mended.entries[mended.step], worlds_->possible.UnprovedAt(unproved->after)));
  }

  void NoteNeighbours(MomentId after) {
    const std::vector<Unproved>& unproved = worlds_->possible.UnprovedAt(after);
    if (!std::ranges::all_of(unproved, DependsOnPlace)) return;
    for (const Unproved& goal : unproved) {
      if (!goal.neighbour.IsNone()) obstacles_.insert(goal.neighbour);
    }
  }

  MomentId MomentAfter(const Mended& mended) const {
    MomentId moment = worlds_->possible.Beginning();
    for (int i = 0; i <= mended.step; ++i) {
      moment = After(worlds_->possible, moment, mended.entries[i]);
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
    // Those of the first phase tell which parts were moved for it.
    std::vector<Resolution> resolutions = std::move(step.certificate.resolutions);
    step.certificate = std::move(certified.certificate);
    step.certificate.resolutions = std::move(resolutions);
    for (const Measure& measure : entry.measures) {
      step.certificate.resolutions.push_back(InWords(measure));
    }
    if (Fails(entry)) AddVerification(*problem_, entry.id, step.action, step.certificate, plan);
  }

  // What was inserted was certified for the order of execution; what was not may be, too.
  bool IsProvedInEveryOrder(const plan::Plan& instance) const {
    if (entries_.size() > steps_) return false;
    const auto is_proved_in = [&](const std::vector<plan::StepId>& order) {
      MomentId moment = worlds_->possible.Beginning();
      return std::ranges::all_of(order, [&](plan::StepId id) {
        const Entry& entry = *std::ranges::find(entries_, id, &Entry::id);
        moment = After(worlds_->possible, moment, entry);
        return Fails(entry) || IsProved(worlds_->possible, moment, entry);
      });
    };
    return plan::VisitLinearizations(
        static_cast<int>(steps_), instance.ordering, [&](const auto& order) {
          return is_proved_in(order) ? plan::Visit::kContinue : plan::Visit::kStop;
        });
  }

  std::vector<std::pair<plan::StepId, plan::StepId>> OrderOfExecution() const {
    std::vector<std::pair<plan::StepId, plan::StepId>> ordering;
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      ordering.emplace_back(entries_[i - 1].id, entries_[i].id);
    }
    return ordering;
  }

  const domain::Problem* problem_;
  std::size_t steps_;  // of the instance: ids from here on are those of inserted steps
  const UncertaintyOptions* options_;
  Worlds* worlds_;
  std::vector<Entry> entries_;  // in the order of execution
  IfUnproved if_unproved_ = IfUnproved::kPrepare;
  std::int64_t combinations_ = 0;
  std::set<PartId> obstacles_ = {};  // of the remedies for the step that was mended last
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

// Steps that no remedies can better, wherever on the table parts are.
int CertainErrors(const plan::Plan& instance, const UncertaintyOptions& options, Worlds& worlds) {
  if (!worlds.best) return 0;
  const std::vector<std::string> absorbable = Absorbable(options);
  MomentId moment = worlds.best->Beginning();
  int errors = 0;
  for (const plan::StepId id : instance.ExecutionOrder()) {
    moment = worlds.best->After(moment, instance.step(id).action, nullptr);
    errors +=
        std::ranges::all_of(worlds.best->UnprovedAt(moment, absorbable), DependsOnPlace) ? 0 : 1;
  }
  return errors;
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
  BestInstance(const domain::Problem& problem, const UncertaintyOptions& options, Worlds& worlds)
      : problem_(problem),
        options_(options),
        worlds_(worlds),
        for_violation_(options.instances_for_violation) {}

  void Consider(const plan::Plan& instance) {
    const Standing least = LeastStanding(instance, options_, worlds_);
    certain_errors_ = std::min(certain_errors_, CertainErrors(instance, options_, worlds_));
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

  void TakeIfBetter(const plan::Plan& instance) {
    Augmentation augmentation(problem_, instance, options_, worlds_);
    combinations_ += augmentation.combinations();
    if (best_ && !(augmentation.standing() < best_->augmentation.standing())) return;
    best_ = {instance, std::move(augmentation)};
  }

  bool exists() const { return best_.has_value(); }
  int errors() const { return best_->augmentation.errors(); }  // of the best
  std::vector<Subject> FailingAnywhere() const { return best_->augmentation.FailingAnywhere(); }
  std::int64_t actions() const { return std::ssize(best_->instance.steps); }
  // The least of all that were considered.
  int certain_errors() const { return certain_errors_; }
  bool is_proved() const { return exists() && errors() == 0; }
  plan::Plan WriteOut() const { return best_->augmentation.WriteOut(best_->instance).plan; }
  std::int64_t combinations() const { return combinations_; }  // of remedies that were tried

 private:
  struct Waiting {
    Standing least;
    plan::Plan instance;
  };

  struct Augmented {
    plan::Plan instance;
    Augmentation augmentation;
  };

  // Whether it might come before the best one; few of those that might do so by their violation
  // alone.
  bool IsWorthAugmenting(const Standing& least) {
    if (!best_) return true;
    const Standing best = best_->augmentation.standing();
    if (!(least < best)) return false;
    const bool may_have_fewer =
        std::tie(least.errors, least.actions) < std::tie(best.errors, best.actions);
    return may_have_fewer || for_violation_-- > 0;
  }

  const domain::Problem& problem_;
  const UncertaintyOptions& options_;
  Worlds& worlds_;
  std::int64_t for_violation_;  // that are still to be augmented
  int certain_errors_ = std::numeric_limits<int>::max();
  std::vector<Waiting> waiting_;
  std::optional<Augmented> best_;
  std::int64_t combinations_ = 0;
};

// Steps of an instance that need not be proved.
struct Allowance {
  std::int64_t errors = 0;
  std::int64_t by_place = 0;           // of these, that fail because of where parts are
  std::vector<Subject> anywhere = {};  // of the others

  bool Covers(const domain::Problem& problem, std::span<const plan::Action> actions,
              const std::vector<Objection>& objections) const {
    const auto may_fail = [&](const Objection& objection) {
      const Subject subject = SubjectOf(problem, actions[objection.action]);
      return objection.place || std::ranges::count(anywhere, subject) > 0;
    };
    return std::ssize(objections) <= errors &&
           std::ranges::count_if(objections, &Objection::place) <= by_place &&
           std::ranges::all_of(objections, may_fail);
  }
};

// Objects to instances as soon as more of their steps than are allowed cannot be proved. A search
// comes back to how instances begin, whatever partial plan they are of: each beginning is judged
// once.
class InstanceJudge {
 public:
  InstanceJudge(const domain::Problem& problem, const UncertaintyOptions& options, Worlds& worlds,
                Allowance allowance, IfUnproved if_unproved)
      : problem_(problem),
        worlds_(worlds),
        allowance_(std::move(allowance)),
        if_unproved_(if_unproved) {
    beginnings_.push_back({.augmentation = Augmentation(problem, kMostSteps, options, worlds)});
  }

  Judgement Judge(std::span<const plan::Action> actions) {
    const std::int64_t moments = worlds_.moments();
    way_.resize(actions.size());
    way_.push_back(After(way_.back(), actions));
    const Beginning& judged = beginnings_[way_.back()];
    return {.objections = judged.augmentation ? std::vector<Objection>{} : judged.objections,
            .moments = 1 + worlds_.moments() - moments};
  }

 private:
  // The first actions of instances, as they were judged.
  struct Beginning {
    plan::Action last = {};
    std::optional<Augmentation> augmentation = {};  // none: there are too many objections
    std::vector<Objection> objections = {};         // to steps that fail
    std::vector<std::size_t> longer = {};           // those by one action
  };

  std::size_t After(std::size_t before, std::span<const plan::Action> actions) {
    for (const std::size_t known : beginnings_[before].longer) {
      if (beginnings_[known].last == actions.back()) return known;
    }
    beginnings_[before].longer.push_back(beginnings_.size());
    beginnings_.push_back(Judged(beginnings_[before], actions));
    return beginnings_.size() - 1;
  }

  Beginning Judged(const Beginning& before, std::span<const plan::Action> actions) const {
    Beginning longer = {actions.back(), before.augmentation, before.objections};
    Augmentation& augmentation = *longer.augmentation;
    if (!augmentation.Add(plan::StepId(actions.size() - 1), actions.back(), if_unproved_)) {
      longer.objections.push_back(augmentation.ObjectionToLast());
    }
    if (!allowance_.Covers(problem_, actions, longer.objections)) longer.augmentation.reset();
    return longer;
  }

  const domain::Problem& problem_;
  Worlds& worlds_;
  Allowance allowance_;
  IfUnproved if_unproved_;
  std::deque<Beginning> beginnings_;    // without any action first
  std::vector<std::size_t> way_ = {0};  // to what was judged last, by how many actions
};

class CertifiedPlanning {
 public:
  CertifiedPlanning(const domain::Problem& problem, const PlannerOptions& planner,
                    const UncertaintyOptions& options)
      : problem_(problem),
        planner_(planner),
        options_(options),
        relations_(problem),
        worlds_(problem, options),
        best_(problem, options, worlds_) {}

  // The first instances tell how many errors no search can spare; those beyond are searched for.
  plan::PlanResult Run() {
    plan::PlanResult result = AmongTheFirst();
    if (!best_.exists()) return Answer(std::move(result));
    // What fails with all grasps that there are may not fail with one that parts are in the way of.
    Search(0, {}, result);
    const std::vector<Subject> anywhere = best_.FailingAnywhere();
    const int least = std::max(best_.certain_errors(), static_cast<int>(anywhere.size()));
    for (int errors = std::max(1, least); errors < best_.errors(); ++errors) {
      Search(errors, anywhere, result);
    }
    if (best_.is_proved() && best_.actions() > result.counters.at("least_actions")) {
      Join(WithErrors(0, {}, IfUnproved::kObject), result);  // which may spare actions
    }
    return Answer(std::move(result));
  }

 private:
  // Unless the best plan has no more errors.
  void Search(int errors, const std::vector<Subject>& anywhere, plan::PlanResult& result) {
    for (const IfUnproved way : {IfUnproved::kObjectAtOnce, IfUnproved::kObject}) {
      if (errors < best_.errors()) Join(WithErrors(errors, anywhere, way), result);
    }
  }

  // Looks for a plan in which so many steps are not proved, at most: steps that fail are mended by
  // other instances, and by goals for the first phase. `anywhere`: what fails wherever parts are in
  // the best plan. Other places are mostly found sooner than remedies that make them unnecessary.
  plan::PlanResult WithErrors(int errors, const std::vector<Subject>& anywhere,
                              IfUnproved if_unproved) {
    const int by_place = std::max(0, errors - static_cast<int>(anywhere.size()));
    InstanceJudge judge(problem_, options_, worlds_, {errors, by_place, anywhere}, if_unproved);
    PlannerOptions first_phase = planner_;
    first_phase.moments = options_.moments;
    first_phase.judge = [&](std::span<const plan::Action> actions) { return judge.Judge(actions); };
    std::int64_t refused = 0;
    first_phase.accept = [&](const plan::Plan& instance) {
      if (!CanBeExecuted(instance)) return ++refused >= options_.instances;
      best_.TakeIfBetter(instance);
      return true;
    };
    return MakePlan(problem_, relations_, first_phase);
  }

  // The best of the first instances, with whatever errors.
  plan::PlanResult AmongTheFirst() {
    PlannerOptions first_phase = planner_;
    std::int64_t considered = 0;
    first_phase.accept = [&](const plan::Plan& instance) {
      if (CanBeExecuted(instance)) best_.Consider(instance);
      return best_.is_proved() || ++considered >= options_.instances;
    };
    plan::PlanResult result = MakePlan(problem_, relations_, first_phase);
    if (!best_.is_proved()) best_.ConsiderWaiting();
    return result;
  }

  bool CanBeExecuted(const plan::Plan& instance) const {
    return !options_.can_be_executed || options_.can_be_executed(instance);
  }

  // Counts the work of another search, whose outcome is the last.
  static void Join(plan::PlanResult other, plan::PlanResult& result) {
    result.outcome = other.outcome;
    for (const auto& [name, count] : other.counters) {
      if (name != "least_actions") result.counters[name] += count;
    }
  }

  plan::PlanResult Answer(plan::PlanResult result) {
    result.counters["remedies"] = best_.combinations();
    if (best_.exists()) {
      result.outcome = Outcome::kFound;
      result.conflict.clear();
      result.plan = best_.WriteOut();
    } else if (result.outcome == Outcome::kFound) {  // but nothing that can be executed
      result.outcome = Outcome::kBudget;
      result.plan = {};
    }
    return result;
  }

  const domain::Problem& problem_;
  const PlannerOptions& planner_;
  const UncertaintyOptions& options_;
  const GeometricRelations relations_;
  Worlds worlds_;
  BestInstance best_;
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
  return Augmentation(problem, instance, complete, worlds).WriteOut(instance);
}

plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem, const PlannerOptions& planner,
                                   const UncertaintyOptions& options) {
  ASSAY_CHECK(!planner.accept && !planner.judge,
              "which instance is accepted is for the uncertainty phase to say");
  const UncertaintyOptions complete = WithDefaults(options);
  return CertifiedPlanning(problem, planner, complete).Run();
}

}  // namespace assay::posting
