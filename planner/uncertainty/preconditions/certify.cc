#include "planner/uncertainty/preconditions/certify.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "planner/algebra/bounding_methods/glance.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/expression/text.h"
#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"
#include "planner/uncertainty/error_sets/release.h"
#include "planner/uncertainty/error_sets/sensing.h"
#include "planner/uncertainty/error_sets/squeezing.h"
#include "planner/uncertainty/preconditions/bounded_claim.h"
#include "planner/uncertainty/standing/dragging.h"

namespace assay::uncertainty {
namespace {

using algebra::Bound;
using plan::CertifiedPrecondition;
using plan::Relation;

enum class Effort { kPropagate, kDerive, kDecideFirst, kDecideAll, kCertify };

// Returns the first-order bound on the side of the limit, if the request allows methods of its
// kind.
std::optional<Bound> FirstOrder(const Precondition& precondition, const UncertainWorld& world,
                                const algebra::BoundRequest& request) {
  if (request.highest < algebra::BoundingMethod::kCentred) return std::nullopt;
  return precondition.relation == Relation::kLess ? world.FirstOrderAbove(precondition.expression)
                                                  : world.FirstOrderBelow(precondition.expression);
}

class StepCertifier {
 public:
  StepCertifier(UncertainWorld& world, Effort effort, const algebra::BoundRequest& request,
                const plan::Action& action, const plan::Strategy* strategy, const Theory& theory)
      : world_(world),
        effort_(effort),
        request_(request),
        action_(action),
        strategy_(strategy),
        theory_(theory) {}

  CertifiedStep Run() {
    Do(action_);
    return Take();
  }

  std::vector<Precondition> Derived() {
    Do(action_);
    return std::move(derived_);
  }

 private:
  void Do(const plan::Action& action) {
    if (action.kind->Has(domain::Argument::kSensor)) return Sense(action);
    ASSAY_CHECK(plan::HoldIn(action) != nullptr, "the errors after {} are not modelled",
                action.kind->name);
    switch (action.kind->leaves) {
      case domain::Leaves::kInHand:
        return Pickup(action);
      case domain::Leaves::kWhereItWas:
        return Squeeze(action);
      case domain::Leaves::kAtPlace:
        return Putdown(action);
      case domain::Leaves::kMated:
        return Assemble(action);
    }
  }

  void Pickup(const plan::Action& pickup) {
    const HandWork work = Grasp(pickup.part, pickup.hold);
    world_.SetHeld(pickup.part, work.held);
    After(pickup.part, PossibleGrasp(work.held, work.draw, world_.propagation()));
  }

  void Squeeze(const plan::Action& squeeze) {
    const HandWork work = Grasp(squeeze.part, squeeze.hold);
    const BelievedShift shift = world_.shift(squeeze.part);
    const Expression height = world_.resting(squeeze.part).displacement[2];
    world_.SetHeld(squeeze.part, work.held);
    RestingError error = Release(world_, squeeze.part, squeeze.hold,
                                 PossibleGrasp(work.held, work.draw, world_.propagation()),
                                 work.draw, world_.X_WorldPart(squeeze.part));
    error.displacement[2] = height;  // the part stays on the table
    world_.SetResting(squeeze.part, world_.X_WorldPart(squeeze.part), error, shift);
    After(squeeze.part);
  }

  void Putdown(const plan::Action& putdown) {
    HandWork work = Carried(putdown.part, putdown.hold, putdown.place.X_WorldPart);
    work.table = world_.DrawTableHeight(putdown.part);
    Before(putdown.part, work.X_ToolGrasp);
    RequireAll(work, [&] {
      work.released = ReleaseOnTable(world_, putdown.part, putdown.hold, work.X_ToolGrasp,
                                     work.draw, work.X_WorldPart);
      Expression& height = work.released.displacement[2];
      work.farther = height - work.table;
      height = work.table;
    });
    world_.SetResting(putdown.part, work.X_WorldPart, work.released, {});
    After(putdown.part);
  }

  void Assemble(const plan::Action& assemble) {
    const domain::Mating& mating = world_.problem().mating(assemble.mating);
    HandWork work =
        Carried(mating.held, assemble.hold, world_.X_WorldPart(mating.fixed) * mating.X_FixedHeld);
    Before(mating.held, work.X_ToolGrasp);
    Before(mating.fixed);
    RequireAll(work, [&] {
      work.released = strategy_ != nullptr ? LedToSeat(world_, assemble.mating)
                                           : ReleaseInSeat(world_, assemble.mating, assemble.hold,
                                                           work.X_ToolGrasp, work.draw);
    });
    std::vector<Drag> drags;
    if (strategy_ == nullptr) drags = DragsOf(world_, assemble.mating, assemble.hold, work.draw);
    DragAlong(world_, drags);
    world_.SetResting(mating.held, work.X_WorldPart, work.released,
                      world_.ShiftAt(mating.fixed, work.X_WorldPart.translation()));
    After(mating.held);
    After(mating.fixed);
    for (const Drag& drag : drags)
      if (drag.part != mating.fixed) After(drag.part);
  }

  void Sense(const plan::Action& sense) {
    Before(sense.part);
    ApplySensing(world_, sense.part, sense.sensor);
    After(sense.part);
  }

  bool certifies() const { return effort_ == Effort::kCertify; }
  // Returns whether there is more to find out about preconditions.
  bool decides() const {
    const bool is_answered = effort_ == Effort::kDecideFirst && !certified_.unproved.empty();
    return effort_ != Effort::kPropagate && !is_answered;
  }

  template <class... Where>
  void Before(PartId part, const Where&... where) {
    if (!certifies()) return;
    certified_.certificate.before.push_back(ErrorSetOf(world_, part, where...));
  }
  template <class... Where>
  void After(PartId part, const Where&... where) {
    if (!certifies()) return;
    certified_.certificate.after.push_back(ErrorSetOf(world_, part, where...));
  }

  // Closes the pads on a part, and requires the preconditions of the step.
  HandWork Grasp(PartId part, const plan::Hold& hold) {
    const ManipulatorError draw = world_.DrawManipulator();
    Before(part);
    HandWork work = {
        world_, action_, strategy_, part, hold, draw, ClosePads(world_, part, hold, draw)};
    RequireAll(work, [] {});
    return work;
  }

  // Returns the work of a hand that brings the part between its pads to a pose.
  HandWork Carried(PartId part, const plan::Hold& hold, const Pose& X_WorldPart) {
    const ManipulatorError draw = world_.DrawManipulator();
    return {.world = world_,
            .action = action_,
            .strategy = strategy_,
            .part = part,
            .hold = hold,
            .draw = draw,
            .held = world_.held(),
            .X_ToolGrasp = PossibleGrasp(world_.held(), draw, world_.propagation()),
            .X_WorldPart = X_WorldPart};
  }

  // Requires all preconditions of the step. `release` lets the part go, and sets work.released. It
  // is called once, as late as possible, because certificates list shared expressions in the order
  // in which they were first formed.
  template <class Release>
  void RequireAll(HandWork& work, const Release& release) {
    bool is_released = false;
    for (const Derivation& derivation : theory_.derivations) {
      if (!decides()) break;
      if (!Applies(derivation)) continue;
      if (derivation.is_of_release && !std::exchange(is_released, true)) release();
      Require(derivation.derive(work));
    }
    if (!is_released) release();
  }

  bool Applies(const Derivation& derivation) const {
    return plan::Needs(derivation.needed_by, action_, strategy_) &&
           (derivation.origin == plan::Origin::kPaper ||
            world_.propagation() == Propagation::kSound);
  }

  void Require(const std::vector<Precondition>& preconditions) {
    if (effort_ == Effort::kDerive) {
      derived_.insert(derived_.end(), preconditions.begin(), preconditions.end());
      return;
    }
    for (const Precondition& precondition : preconditions) {
      if (!decides()) return;
      CertifiedPrecondition claim = certifies() ? Certified(precondition) : Decided(precondition);
      if (!claim.holds()) {
        certified_.unproved.push_back({claim, precondition.expression, precondition.neighbour});
      }
      if (certifies()) certified_.certificate.preconditions.push_back(std::move(claim));
    }
  }

  // First-order bounds prove most claims, and the bounding methods need not run for these claims.
  // The bounding methods would stop at the first method that proves the claim, and its bound would
  // be looser.
  CertifiedPrecondition Certified(const Precondition& precondition) {
    std::optional<Bound> bound = FirstOrder(precondition, world_, request_);
    if (!bound || !ClaimOf(precondition, *bound).holds()) bound = Searched(precondition);
    CertifiedPrecondition claim = ClaimOf(precondition, *bound);
    Detail(precondition, *bound, claim);
    return claim;
  }

  // The bounding methods may stop at the wanted gap with a looser bound than a quick bound that
  // proves the claim.
  Bound Searched(const Precondition& precondition) const {
    Bound bound = ToldBound(precondition, world_, request_);
    if (ClaimOf(precondition, bound).holds()) return bound;
    const auto seen = AtAGlance(precondition);
    if (!seen || !seen->holds()) return bound;
    Tighten({.value = seen->bound, .method = algebra::BoundingMethod::kCentred},
            precondition.relation, bound);
    return bound;
  }

  CertifiedPrecondition Decided(const Precondition& precondition) const {
    const std::optional<CertifiedPrecondition> seen = AtAGlance(precondition);
    return seen ? *seen : ClaimOf(precondition, BoundOf(precondition, world_, request_));
  }

  // Quick bounds decide most claims, although they are looser. They prove what the centred bounding
  // method proves. If the request allows only weaker methods, quick bounds are not used, because
  // they could prove a claim that the certificate does not prove.
  std::optional<CertifiedPrecondition> AtAGlance(const Precondition& precondition) const {
    if (request_.highest < algebra::BoundingMethod::kCentred) return std::nullopt;
    const Expression& expression = precondition.expression;
    const double limit = precondition.limit;
    const bool less = precondition.relation == Relation::kLess;
    auto seen = Seen(precondition, less ? world_.GlanceAbove(expression, limit)
                                        : world_.GlanceBelow(expression, limit));
    if (seen) return seen;
    const std::vector<Interval>& box = world_.constraints().box;
    return Seen(precondition, less ? algebra::GlanceAbove(expression, box, limit)
                                   : algebra::GlanceBelow(expression, box, limit));
  }

  void Detail(const Precondition& precondition, const Bound& bound, CertifiedPrecondition& claim) {
    expressions_.push_back(precondition.expression);
    if (bound.at.empty()) return;
    for (const algebra::VariableId v : algebra::VariablesOf(precondition.expression)) {
      claim.worst.push_back({world_.NameOf(v), bound.at[v.index()]});
    }
  }

  CertifiedStep Take() {
    plan::Certificate& certificate = certified_.certificate;
    certificate.variables = world_.VariablesIn(expressions_);
    algebra::SharedTexts texts = algebra::TextsOf(expressions_);
    certificate.shared = std::move(texts.shared);
    for (std::size_t i = 0; i < expressions_.size(); ++i) {
      certificate.preconditions[i].expression = std::move(texts.expressions[i]);
    }
    return std::move(certified_);
  }

  UncertainWorld& world_;
  Effort effort_;
  const algebra::BoundRequest& request_;
  const plan::Action& action_;
  const plan::Strategy* strategy_;
  const Theory& theory_;
  std::vector<Precondition> derived_;
  CertifiedStep certified_;
  // Expressions of the certificate's preconditions, in the same order.
  std::vector<Expression> expressions_;
};

}  // namespace

double Violation(const std::vector<Unproved>& unproved) {
  double violation = 0;
  for (const Unproved& unmet : unproved) violation -= unmet.claim.margin;
  return violation;
}

double LeastViolation(const Unproved& unproved, const UncertainWorld& world) {
  const double limit = unproved.claim.limit;
  const double beyond = unproved.claim.relation == Relation::kLess
                            ? world.GlanceAbove(unproved.expression, limit).attained - limit
                            : limit - world.GlanceBelow(unproved.expression, limit).attained;
  return std::max(0., beyond);
}

CertifiedStep CertifyStep(UncertainWorld& world, const plan::Action& action,
                          const algebra::BoundRequest& request, const plan::Strategy* strategy,
                          const Theory& theory) {
  CertifiedStep step =
      StepCertifier(world, Effort::kCertify, request, action, strategy, theory).Run();
  step.certificate.not_needed =
      plan::NotNeededIn(step.certificate.preconditions, action, strategy,
                        world.propagation() == Propagation::kPaper, theory.kinds);
  return step;
}

std::vector<Precondition> PreconditionsOf(UncertainWorld& world, const plan::Action& action,
                                          const plan::Strategy* strategy) {
  const algebra::BoundRequest none;
  return StepCertifier(world, Effort::kDerive, none, action, strategy, {}).Derived();
}

std::vector<plan::Certificate> CertificatesAnew(const domain::Problem& problem,
                                                const plan::Plan& plan, Propagation propagation,
                                                const algebra::BoundRequest& request) {
  std::vector<plan::Certificate> certificates(plan.steps.size());
  UncertainWorld world(problem, propagation);
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const plan::PlannedStep& step = plan.step(id);
    const plan::Strategy* strategy = step.strategy ? &*step.strategy : nullptr;
    certificates[id.index()] = CertifyStep(world, step.action, request, strategy).certificate;
  }
  return certificates;
}

std::vector<Unproved> DecideStep(UncertainWorld& world, const plan::Action& action,
                                 const algebra::BoundRequest& request, Wanted wanted,
                                 const plan::Strategy* strategy) {
  const Effort effort =
      wanted == Wanted::kFirstUnproved ? Effort::kDecideFirst : Effort::kDecideAll;
  return StepCertifier(world, effort, request, action, strategy, {}).Run().unproved;
}

Unproved AsCertified(Unproved unproved, const UncertainWorld& world,
                     const algebra::BoundRequest& request) {
  const Precondition precondition = {.condition = unproved.claim.condition,
                                     .meaning = unproved.claim.meaning,
                                     .expression = unproved.expression,
                                     .relation = unproved.claim.relation,
                                     .limit = unproved.claim.limit,
                                     .circumstance = unproved.claim.circumstance};
  unproved.claim = ClaimOf(precondition, ToldBound(precondition, world, request));
  return unproved;
}

void Propagate(UncertainWorld& world, const plan::Action& action, const plan::Strategy* strategy) {
  const algebra::BoundRequest none;
  StepCertifier(world, Effort::kPropagate, none, action, strategy, {}).Run();
}

plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part, const Transform& X_ToolGrasp) {
  const SymbolicVector& offset = X_ToolGrasp.translation;
  return {.part = part,
          .in_hand = true,
          .x = world.TightRangeOf(offset[0]),
          .y = world.TightRangeOf(offset[1]),
          .z = world.TightRangeOf(offset[2]),
          .theta = world.TightRangeOf(world.held().skew) + world.problem().gripper_error.theta,
          .tip = world.TightRangeOf(world.held().tip),
          .twist = world.TightRangeOf(world.held().twist)};
}

plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part) {
  const RestingError& error = world.resting_in_world(part);
  return {.part = part,
          .in_hand = false,
          .x = world.TightRangeOf(error.displacement[0]),
          .y = world.TightRangeOf(error.displacement[1]),
          .z = world.TightRangeOf(error.displacement[2]),
          .theta = world.TightRangeOf(error.theta)};
}

}  // namespace assay::uncertainty
