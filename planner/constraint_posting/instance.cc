#include "planner/constraint_posting/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"
#include "planner/domain/part/resting.h"

namespace assay::constraint_posting {

using domain::ActionKind;
using domain::ActionTemplate;
using domain::GraspId;
using domain::PartId;
using domain::Pose;
using domain::StablePoseId;
using network::NodeId;

namespace {

// The greatest number of orders of one plan that are tried. With one hand there are few orders.
constexpr int kMostOrders = 64;

std::vector<StepId> ActionsOf(const std::vector<StepId>& linearization) {
  std::vector<StepId> actions;
  std::ranges::copy_if(linearization, std::back_inserter(actions), [](StepId step) {
    return step != PartialPlan::kStart && step != PartialPlan::kFinish;
  });
  return actions;
}

plan::Hold HoldOf(const domain::Part& part, int grasp_label) {
  const domain::Grasp& grasp = (*part.grasps)[grasp_label];
  return {.grasp = grasp.label, .X_PartTool = grasp.X_PartTool, .width = grasp.width};
}

plan::Place PlaceOf(const domain::Part& part, const StepValues& values) {
  const bool initial = values.position == domain::InitialLabel(part);
  return {.position = initial ? "initial" : part.model->stable_poses()[values.position].label,
          .X_WorldPart = values.X_WorldPart};
}

plan::Action WriteAction(const domain::Problem& problem, const ActionTemplate& action,
                         const StepValues& values) {
  const domain::Part& part = problem.part(action.part);
  const plan::Hold hold = HoldOf(part, values.grasp);
  switch (action.kind) {
    case ActionKind::kPickup:
      return plan::Pickup{.part = action.part, .hold = hold, .from = PlaceOf(part, values)};
    case ActionKind::kPutdown:
      return plan::Putdown{.part = action.part, .hold = hold, .to = PlaceOf(part, values)};
    case ActionKind::kAssemble:
      return plan::Assemble{
          .mating = action.mating,
          .hold = hold,
          .fixed = PlaceOf(problem.part(problem.mating(action.mating).fixed), values)};
    case ActionKind::kStart:
    case ActionKind::kFinish:
      break;
  }
  ASSAY_CHECK(false, "start and finish are not written out");
  return {};
}

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
        values_(plan.steps().size()),
        assigned_(plan.network().node_count()) {
    ASSAY_CHECK(order_.size() <= kMostSteps);
  }

  bool Run() { return Descend(0); }

  const Blockers& blockers() const { return blockers_; }
  bool met_objections() const { return objections_ > 0; }

 private:
  struct Assignment {
    int label = -1;
    int depth = -1;  // -1 if no value is chosen
  };

  bool Descend(int depth) {
    if (depth == static_cast<int>(order_.size())) return Offer();
    switch (plan_.step(order_[depth]).kind) {
      case ActionKind::kPickup:
        return ChooseGrasp(depth);
      case ActionKind::kPutdown:
        return ChoosePlace(depth);
      case ActionKind::kAssemble:
        return Assemble(depth);
      case ActionKind::kStart:
      case ActionKind::kFinish:
        break;
    }
    ASSAY_CHECK(false, "start and finish are not executed");
    return false;
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

  bool Spend() { return budgets_.values.Spend() && !budgets_.moments.Exhausted(); }

  // Returns true if the judge accepts the step with the value just set. Otherwise `blame` receives
  // the reasons.
  bool Passes(int depth, Blame& blame) {
    if (!judge_) return true;
    actions_.erase(actions_.begin() + depth, actions_.end());
    actions_.push_back(
        WriteAction(plan_.problem(), plan_.step(order_[depth]), values_[order_[depth].index()]));
    const Judgement judgement = judge_(actions_);
    Charge(budgets_.moments, judgement);
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
        if (action.part != part || action.kind == ActionKind::kAssemble) continue;
        const bool rests = action.kind == ActionKind::kPutdown;
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
      if (action.kind == ActionKind::kPutdown) return e;
      if (action.kind == ActionKind::kAssemble) {
        return ChoiceOfPlace(plan_.problem().mating(action.mating).fixed, e);
      }
    }
    return World::kStartChoice;
  }

  // Returns true if the label fits all labels that are already chosen.
  bool Fits(NodeId node, int label, Blame& blame) const {
    for (const network::Arc& arc : plan_.network().arcs()) {
      if (arc.a != node && arc.b != node) continue;
      const Assignment& other = assigned_[(arc.a == node ? arc.b : arc.a).index()];
      if (other.depth < 0) continue;
      const bool allowed = arc.a == node ? arc.relation->Allows(label, other.label)
                                         : arc.relation->Allows(other.label, label);
      if (allowed) continue;
      blame.choices.set(other.depth);
      return false;
    }
    return true;
  }

  void BlamePlaceOf(PartId part, Blame& blame) const {
    if (world_.choice(part) != World::kStartChoice) blame.AddPlace(world_.choice(part));
  }

  bool ChooseGrasp(int depth) {
    const StepId step = order_[depth];
    const ActionTemplate& pickup = plan_.step(step);
    const NodeId node = plan_.NodeOf(pickup.grasp);
    const World before = world_;
    Blame blame;
    BlamePlaceOf(pickup.part, blame);
    values_[step.index()] = {.position = LabelOf(pickup.position),
                             .X_WorldPart = world_.X_WorldPart(pickup.part)};
    for (int grasp : plan_.Labels(pickup.grasp)) {
      if (!Spend()) break;
      if (!Fits(node, grasp, blame) ||
          !geometry_.PickupWorks(world_, step, pickup.part, GraspId(grasp), blame)) {
        continue;
      }
      values_[step.index()].grasp = grasp;
      if (!Passes(depth, blame)) continue;
      assigned_[node.index()] = {.label = grasp, .depth = depth};
      world_.Take(pickup.part);
      const Below below = GoOn(depth, before, blame);
      if (below == Below::kFound) return true;
      assigned_[node.index()] = {};
      if (below == Below::kJumpBack) return false;
    }
    return Fail(blame);
  }

  bool ChoosePlace(int depth) {
    const StepId step = order_[depth];
    const ActionTemplate& putdown = plan_.step(step);
    const NodeId node = plan_.NodeOf(putdown.position);
    const Assignment& grasp = assigned_[plan_.NodeOf(putdown.grasp).index()];
    const domain::Part& part = plan_.problem().part(putdown.part);
    const World before = world_;
    Blame blame;
    for (int label : plan_.Labels(putdown.position)) {
      if (!Fits(node, label, blame)) continue;
      const Pose& X_TablePart = part.model->stable_poses()[label].X_TablePart;
      std::vector<domain::Placement> placements = plan_.problem().workcell->placements();
      for (auto placement = placements.begin(); placement != placements.end(); ++placement) {
        if (!Spend()) return Fail(blame);
        const Pose X_WorldPart = placement->X_WorldTable() * X_TablePart;
        if (!geometry_.HasRoom(world_, step, putdown.part, X_WorldPart, blame)) continue;
        if (!geometry_.PutdownWorks(world_, step, putdown.part, GraspId(grasp.label), X_WorldPart,
                                    blame)) {
          blame.choices.set(grasp.depth);
          continue;
        }
        values_[step.index()] = {
            .grasp = grasp.label, .position = label, .X_WorldPart = X_WorldPart};
        if (!Passes(depth, blame)) continue;
        assigned_[node.index()] = {.label = label, .depth = depth};
        world_.Rest(putdown.part, X_WorldPart, depth);
        const std::int64_t objections = objections_;
        const Below below = GoOn(depth, before, blame);
        if (below == Below::kFound) return true;
        assigned_[node.index()] = {};
        if (below == Below::kJumpBack) return false;
        if (below == Below::kTryOtherLabels) break;
        if (objections_ > objections) PutNearOnesLast(placement, placements.end());
      }
    }
    return Fail(blame);
  }

  // The place `here` is too near to another place. The places of the list that are no farther from
  // that other place are moved to the end of the list.
  using PlacementIterator = std::vector<domain::Placement>::iterator;
  void PutNearOnesLast(PlacementIterator here, PlacementIterator end) const {
    const auto distance = [](const domain::Placement& p, const geometry::Vector3& other) {
      return std::hypot(p.x - other.x(), p.y - other.y());
    };
    const bool is_first = distance(*here, too_near_.first) < distance(*here, too_near_.second);
    const geometry::Vector3& other = is_first ? too_near_.second : too_near_.first;
    constexpr double kSame = 1e-6;  // tolerance for equal distances, metres
    std::stable_partition(here + 1, end, [&](const domain::Placement& placement) {
      return distance(placement, other) > distance(*here, other) + kSame;
    });
  }

  bool Assemble(int depth) {
    const StepId step = order_[depth];
    const ActionTemplate& assemble = plan_.step(step);
    const Assignment& grasp = assigned_[plan_.NodeOf(assemble.grasp).index()];
    const PartId fixed = plan_.problem().mating(assemble.mating).fixed;
    Blame blame;
    if (!geometry_.AssembleWorks(world_, step, assemble.mating, GraspId(grasp.label), blame)) {
      blame.choices.set(grasp.depth);
      BlamePlaceOf(fixed, blame);
      return Fail(blame);
    }
    values_[step.index()] = {.grasp = grasp.label,
                             .position = LabelOf(assemble.position),
                             .X_WorldPart = world_.X_WorldPart(fixed)};
    if (!Passes(depth, blame)) return Fail(blame);
    const World before = world_;
    world_.Mate(assemble.mating);
    if (Descend(depth + 1)) return true;
    world_ = before;
    return false;
  }

  int LabelOf(domain::VariableId position) const {
    const Assignment& chosen = assigned_[plan_.NodeOf(position).index()];
    return chosen.depth >= 0 ? chosen.label : plan_.Labels(position).first();
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
  std::pair<geometry::Vector3, geometry::Vector3> too_near_;
  int offered_ = 0;  // number of instances passed to `accept`
  World world_;
  std::vector<StepValues> values_;
  std::vector<Assignment> assigned_;   // indexed by node
  std::vector<plan::Action> actions_;  // the actions that were judged last, one for each depth
  // the blame of the last Descend that failed, without blockers
  Blame failure_;
};

}  // namespace

InstanceSearch::InstanceSearch(const PartialPlan& plan, const Judge& judge, Budgets budgets)
    : plan_(plan), judge_(judge), budgets_(budgets) {}

bool InstanceSearch::Find(const std::function<bool(const PlanInstance&)>& accept) {
  for (const auto& linearization : plan_.ordering().Linearizations(kMostOrders)) {
    OrderedSearch search(plan_, ActionsOf(linearization), accept, judge_, budgets_);
    if (search.Run()) return true;
    Add(search.blockers(), blockers_);
    met_objections_ |= search.met_objections();
    if (budgets_.Exhausted()) break;
  }
  return false;
}

bool WorksInOrder(const PartialPlan& plan, const PlanInstance& instance,
                  const std::vector<StepId>& order) {
  const StepGeometry geometry(plan.problem(), plan.relations().reachability());
  World world(plan.problem());
  Blame blame;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ActionTemplate& action = plan.step(order[i]);
    const StepValues& values = instance.values[order[i].index()];
    const GraspId grasp(values.grasp);
    switch (action.kind) {
      case ActionKind::kPickup:
        if (!geometry.PickupWorks(world, order[i], action.part, grasp, blame)) return false;
        world.Take(action.part);
        break;
      case ActionKind::kPutdown:
        if (!geometry.HasRoom(world, order[i], action.part, values.X_WorldPart, blame) ||
            !geometry.PutdownWorks(world, order[i], action.part, grasp, values.X_WorldPart,
                                   blame)) {
          return false;
        }
        world.Rest(action.part, values.X_WorldPart, static_cast<int>(i));
        break;
      case ActionKind::kAssemble:
        if (!geometry.AssembleWorks(world, order[i], action.mating, grasp, blame)) return false;
        world.Mate(action.mating);
        break;
      case ActionKind::kStart:
      case ActionKind::kFinish:
        break;
    }
  }
  return true;
}

namespace {

plan::StepId WrittenId(StepId step) { return plan::StepId(step.index() - 2); }

// Adds to a step's certificate that a part was moved because some precondition of the step could
// not be proved.
void NoteWhyMoved(const PartialPlan& partial, plan::Plan& written) {
  for (const RequiredMove& move : partial.required_moves()) {
    if (move.why.empty()) continue;
    const StepId putdown = partial.ProducerOf(move.consumer, move.precondition);
    const StepId pickup = partial.ProducerOf(putdown, 0);  // the producer of holding(part, grasp)
    auto& resolutions = written.steps[WrittenId(move.consumer).index()].certificate.resolutions;
    if (resolutions.empty()) resolutions.push_back({.resolver = "moving", .why = move.why});
    plan::Resolution& moving = resolutions.front();
    if (!moving.steps.empty()) moving.why += "; " + move.why;
    for (const StepId step : {pickup, putdown}) moving.steps.push_back(WrittenId(step));
  }
  const auto executed = [&](plan::StepId step) { return written.step(step).executed; };
  for (plan::PlannedStep& step : written.steps) {
    for (plan::Resolution& moving : step.certificate.resolutions) {
      std::ranges::sort(moving.steps, {}, executed);
    }
  }
}

bool EveryOrderWorks(const PartialPlan& plan, const PlanInstance& instance) {
  const auto linearizations = plan.ordering().Linearizations(kMostOrders);
  if (static_cast<int>(linearizations.size()) == kMostOrders) return false;
  return std::ranges::all_of(linearizations, [&](const auto& linearization) {
    const std::vector<StepId> order = ActionsOf(linearization);
    return order == instance.order || WorksInOrder(plan, instance, order);
  });
}

}  // namespace

plan::Plan WriteOut(const PartialPlan& partial, const PlanInstance& instance) {
  plan::Plan written{.problem = partial.problem().name};
  for (int s = 2; s < static_cast<int>(partial.steps().size()); ++s) {
    const auto executed = std::ranges::find(instance.order, StepId(s)) - instance.order.begin();
    written.steps.push_back(
        {.name = fmt::format("action_{}", s - 1),
         .action = WriteAction(partial.problem(), partial.step(StepId(s)), instance.values[s]),
         .inserted = s - 1,
         .executed = static_cast<int>(executed) + 1});
  }
  NoteWhyMoved(partial, written);
  if (EveryOrderWorks(partial, instance)) {
    for (const auto& [a, b] : partial.ordering().arcs()) {
      if (std::min(a, b) > PartialPlan::kFinish) {
        written.ordering.emplace_back(WrittenId(a), WrittenId(b));
      }
    }
  } else {
    for (std::size_t i = 1; i < instance.order.size(); ++i) {
      written.ordering.emplace_back(WrittenId(instance.order[i - 1]), WrittenId(instance.order[i]));
    }
  }
  return written;
}

}  // namespace assay::constraint_posting
