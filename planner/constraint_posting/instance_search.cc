#include "planner/constraint_posting/instance_search.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "planner/base/check.h"

namespace assay::constraint_posting {

using domain::ActionTemplate;
using domain::GraspId;
using domain::Leaves;
using domain::PartId;
using domain::Pose;
using network::NodeId;

namespace {

// Two positions that are too near to each other.
using TooNear = std::pair<geometry::Vector3, geometry::Vector3>;

// The first place of the list is at one of two positions that are too near to each other. Changes
// the order of the other places: those that are farther from the other position than the first
// place come first.
void PutNearOnesLast(const TooNear& too_near, std::span<domain::Placement> here_and_after) {
  const auto distance = [](const domain::Placement& p, const geometry::Vector3& other) {
    return std::hypot(p.x - other.x(), p.y - other.y());
  };
  const domain::Placement here = here_and_after.front();
  const bool is_first = distance(here, too_near.first) < distance(here, too_near.second);
  const geometry::Vector3& other = is_first ? too_near.second : too_near.first;
  constexpr double kSame = 1e-6;  // tolerance for equal distances, metres
  std::ranges::stable_partition(here_and_after.subspan(1), [&](const domain::Placement& placement) {
    return distance(placement, other) > distance(here, other) + kSame;
  });
}

// The labels that are chosen for plan variables, each at some depth of the search.
class ChosenLabels {
 public:
  struct Choice {
    int label = -1;
    int depth = -1;  // -1 if no label is chosen
  };

  explicit ChosenLabels(const PartialPlan& plan)
      : plan_(plan), chosen_(plan.network().node_count()) {}

  void Choose(VariableId variable, const Choice& choice) { At(variable) = choice; }
  void Forget(VariableId variable) { At(variable) = {}; }

  // Returns no choice if the action has no grasp.
  Choice GraspOf(const ActionTemplate& action) const {
    if (action.grasp.IsNone()) return {};
    return chosen_[plan_.NodeOf(action.grasp).index()];
  }
  int LabelOf(VariableId position) const {
    const Choice& choice = chosen_[plan_.NodeOf(position).index()];
    return choice.depth >= 0 ? choice.label : plan_.Labels(position).first();
  }

  // Returns true if the label fits all labels that are already chosen.
  bool Fits(VariableId variable, int label, Blame& blame) const {
    const NodeId node = plan_.NodeOf(variable);
    for (const network::Arc& arc : plan_.network().arcs()) {
      if (arc.a != node && arc.b != node) continue;
      const Choice& other = chosen_[(arc.a == node ? arc.b : arc.a).index()];
      if (other.depth < 0) continue;
      const bool allowed = arc.a == node ? arc.relation->Allows(label, other.label)
                                         : arc.relation->Allows(other.label, label);
      if (allowed) continue;
      blame.choices.set(other.depth);
      return false;
    }
    return true;
  }

 private:
  Choice& At(VariableId variable) { return chosen_[plan_.NodeOf(variable).index()]; }

  const PartialPlan& plan_;
  std::vector<Choice> chosen_;  // indexed by node
};

class OrderedSearch {
 public:
  using Accept = std::function<bool(const PlanInstance&)>;

  OrderedSearch(const PartialPlan& plan, std::vector<StepId> order, const Accept& accept,
                const Judge& judge, InstanceSearch::Budgets budgets)
      : plan_(plan),
        geometry_(plan.problem(), plan.relations().reachability()),
        order_(std::move(order)),
        accept_(accept),
        judge_(judge),
        budgets_(budgets),
        world_(plan.problem()),
        labels_(plan),
        values_(plan.steps().size()) {
    ASSAY_CHECK(order_.size() <= kMostSteps);
  }

  bool Run() { return Descend(0); }

  const Blockers& blockers() const { return blockers_; }
  bool met_objections() const { return objections_ > 0; }

 private:
  bool Descend(int depth) {
    if (depth == static_cast<int>(order_.size())) return Offer();
    const ActionTemplate& action = plan_.step(order_[depth]);
    if (action.initial.empty()) return Execute(depth);
    const domain::VariableId own = action.initial.front().variable;
    return own == action.grasp ? ChooseGrasp(depth) : ChoosePlace(depth);
  }

  // If an instance is not accepted, every choice takes part in the failure, because another value
  // of any choice may help.
  bool Offer() {
    ++offered_;
    if (accept_({.order = order_, .values = values_})) return true;
    failure_ = {};
    failure_.choices.set();
    return false;
  }

  // Searches the choices after `depth`, for which a value was just set. On failure, `blame`
  // receives the reasons, and the result says which other values for `depth` could help. If the
  // label took part in the failure but not the place, other places with the same label cannot help.
  enum class Below { kFound, kTryOtherPlaces, kTryOtherLabels, kJumpBack };
  Below GoOn(int depth, const World& before, Blame& blame) {
    const int offered = offered_;
    if (Descend(depth + 1)) return Below::kFound;
    world_ = before;
    if (budgets_.Exhausted() || !failure_.choices.test(depth)) return Below::kJumpBack;
    const bool by_place = failure_.places.test(depth) && offered == offered_;
    failure_.choices.reset(depth);
    failure_.places.reset(depth);
    blame.Add(failure_);
    return by_place ? Below::kTryOtherPlaces : Below::kTryOtherLabels;
  }

  bool Fail(const Blame& blame) {
    failure_ = {.choices = blame.choices, .places = blame.places};
    Add(blame.blockers, blockers_);
    return false;
  }

  bool Spend() { return budgets_.values.Spend() && !budgets_.snapshots.Exhausted(); }

  // Returns true if the judge accepts the step with the value just set. Otherwise `blame` receives
  // the reasons.
  bool Passes(int depth, Blame& blame) {
    if (!judge_) return true;
    actions_.erase(actions_.begin() + depth, actions_.end());
    actions_.push_back(
        WriteAction(plan_.problem(), plan_.step(order_[depth]), values_[order_[depth].index()]));
    const Judgement judgement = judge_(actions_);
    Charge(budgets_.snapshots, judgement);
    for (const Objection& objection : judgement.objections) AddBlame(objection, depth, blame);
    if (!judgement.objections.empty()) NoteTooNear(judgement.objections.back());
    objections_ += std::ssize(judgement.objections);
    return judgement.objections.empty();
  }

  // Adds the choices before `depth` that take part in an objection, and the parts that no step has
  // moved.
  void AddBlame(const Objection& objection, int depth, Blame& blame) const {
    for (const PartId part : objection.parts) {
      for (int e = std::min(objection.action, depth - 1); e >= 0; --e) {
        const ActionTemplate& action = plan_.step(order_[e]);
        if (action.part != part || action.kind->leaves == Leaves::kMated) continue;
        const bool rests = action.kind->leaves == Leaves::kAtPlace;
        blame.choices.set(e);
        if (rests && objection.place) blame.places.set(e);
        if (rests && !objection.history) break;
      }
    }
    for (const auto& [part, why] : objection.in_the_way) {
      blame.Add(ChoiceOfPlace(part, objection.action), order_[objection.action], part, why);
    }
  }

  void NoteTooNear(const Objection& objection) {
    const StepId step = order_[objection.action];
    too_near_ = {values_[step.index()].X_WorldPart.translation(),
                 values_[step.index()].X_WorldPart.translation()};
    for (const auto& [part, why] : objection.in_the_way) {
      too_near_.second = world_.X_WorldPart(part).translation();
    }
  }

  // Returns the choice that put the part where it is before a step.
  int ChoiceOfPlace(PartId part, int before) const {
    for (int e = before - 1; e >= 0; --e) {
      const ActionTemplate& action = plan_.step(order_[e]);
      if (action.part != part) continue;
      if (action.kind->leaves == Leaves::kAtPlace) return e;
      if (action.kind->leaves == Leaves::kMated) {
        return ChoiceOfPlace(plan_.problem().mating(action.mating).fixed, e);
      }
    }
    return World::kStartChoice;
  }

  void BlamePlaceOf(PartId part, Blame& blame) const {
    if (world_.choice(part) != World::kStartChoice) blame.AddPlace(world_.choice(part));
  }

  bool ChooseGrasp(int depth) {
    const StepId step = order_[depth];
    const ActionTemplate& action = plan_.step(step);
    const World before = world_;
    Blame blame;
    BlamePlaceOf(action.part, blame);
    StepValues& values = values_[step.index()];
    values = {.position = labels_.LabelOf(action.position),
              .X_WorldPart = world_.X_WorldPart(action.part)};
    for (int grasp : plan_.Labels(action.grasp)) {
      if (!Spend()) break;
      if (!labels_.Fits(action.grasp, grasp, blame) ||
          !geometry_.Works(world_, step, action, GraspId(grasp), values.X_WorldPart, blame)) {
        continue;
      }
      values.grasp = grasp;
      if (!Passes(depth, blame)) continue;
      labels_.Choose(action.grasp, {.label = grasp, .depth = depth});
      world_.Do(action, values.X_WorldPart, depth);
      const Below below = GoOn(depth, before, blame);
      if (below == Below::kFound) return true;
      labels_.Forget(action.grasp);
      if (below == Below::kJumpBack) return false;
    }
    return Fail(blame);
  }

  bool ChoosePlace(int depth) {
    const StepId step = order_[depth];
    const ActionTemplate& action = plan_.step(step);
    const ChosenLabels::Choice grasp = labels_.GraspOf(action);
    const World before = world_;
    Blame blame;
    for (int label : plan_.Labels(action.position)) {
      if (!labels_.Fits(action.position, label, blame)) continue;
      const Pose& X_TablePart =
          plan_.problem().part(action.part).model->stable_poses()[label].X_TablePart;
      std::vector<domain::Placement> placements = plan_.problem().workcell->placements();
      for (auto placement = placements.begin(); placement != placements.end(); ++placement) {
        if (!Spend()) return Fail(blame);
        const Pose X_WorldPart = placement->X_WorldTable() * X_TablePart;
        if (!HasPlace(step, action, grasp, X_WorldPart, blame)) continue;
        values_[step.index()] = {
            .grasp = grasp.label, .position = label, .X_WorldPart = X_WorldPart};
        if (!Passes(depth, blame)) continue;
        labels_.Choose(action.position, {.label = label, .depth = depth});
        world_.Do(action, X_WorldPart, depth);
        const std::int64_t objections = objections_;
        const Below below = GoOn(depth, before, blame);
        if (below == Below::kFound) return true;
        labels_.Forget(action.position);
        if (below == Below::kJumpBack) return false;
        if (below == Below::kTryOtherLabels) break;
        if (objections_ > objections) PutNearOnesLast(too_near_, {placement, placements.end()});
      }
    }
    return Fail(blame);
  }

  // Tests a place for the part. If only the hand is in the way, another grasp may help.
  bool HasPlace(StepId step, const ActionTemplate& action, const ChosenLabels::Choice& grasp,
                const Pose& X_WorldPart, Blame& blame) const {
    if (!geometry_.HasRoom(world_, step, action.part, X_WorldPart, blame)) return false;
    const GraspId id(grasp.label);
    if (geometry_.WorksGivenRoom(world_, step, action, id, X_WorldPart, blame)) return true;
    if (grasp.depth >= 0) blame.choices.set(grasp.depth);
    return false;
  }

  // Executes an action that has no choice of its own.
  bool Execute(int depth) {
    const StepId step = order_[depth];
    const ActionTemplate& action = plan_.step(step);
    const ChosenLabels::Choice grasp = labels_.GraspOf(action);
    const PartId placed =
        action.mating.IsNone() ? action.part : plan_.problem().mating(action.mating).fixed;
    Blame blame;
    StepValues& values = values_[step.index()];
    values = {.grasp = grasp.label,
              .position = labels_.LabelOf(action.position),
              .X_WorldPart = world_.X_WorldPart(placed)};
    if (!geometry_.Works(world_, step, action, GraspId(grasp.label), values.X_WorldPart, blame)) {
      if (grasp.depth >= 0) blame.choices.set(grasp.depth);
      BlamePlaceOf(placed, blame);
      return Fail(blame);
    }
    if (!Passes(depth, blame)) return Fail(blame);
    const World before = world_;
    world_.Do(action, values.X_WorldPart, depth);
    if (Descend(depth + 1)) return true;
    world_ = before;
    return false;
  }

  const PartialPlan& plan_;
  StepGeometry geometry_;
  std::vector<StepId> order_;
  const Accept& accept_;
  const Judge& judge_;
  InstanceSearch::Budgets budgets_;
  Blockers blockers_;
  std::int64_t objections_ = 0;
  // The positions, in the last objection, of the action's part and of the part in its way.
  TooNear too_near_;
  int offered_ = 0;  // number of instances passed to `accept`
  World world_;
  ChosenLabels labels_;
  std::vector<StepValues> values_;
  std::vector<plan::Action> actions_;  // the actions that were judged last, one for each depth
  // the blame of the last Descend that failed, without blockers
  Blame failure_;
};

}  // namespace

InstanceSearch::InstanceSearch(const PartialPlan& plan, const Judge& judge, Budgets budgets)
    : plan_(plan), judge_(judge), budgets_(budgets) {}

bool InstanceSearch::Find(const std::function<bool(const PlanInstance&)>& accept) {
  for (const std::vector<StepId>& order : OrdersOf(plan_)) {
    OrderedSearch search(plan_, order, accept, judge_, budgets_);
    if (search.Run()) return true;
    Add(search.blockers(), blockers_);
    met_objections_ |= search.met_objections();
    if (budgets_.Exhausted()) break;
  }
  return false;
}

}  // namespace assay::constraint_posting
