#include "planner/uncertainty/preconditions/certify.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/algebra/expression/text.h"
#include "planner/algebra/methods/glance.h"
#include "planner/algebra/numeric/interval_arithmetic.h"
#include "planner/base/check.h"
#include "planner/domain/mating/shaft_fit.h"
#include "planner/plan/data/condition_kind.h"
#include "planner/uncertainty/errors/mating_end.h"
#include "planner/uncertainty/errors/release.h"
#include "planner/uncertainty/errors/sensing.h"
#include "planner/uncertainty/errors/squeezing.h"

namespace assay::uncertainty {
namespace {

using algebra::Bound;
using plan::CertifiedPrecondition;
using plan::Relation;

enum class Effort { kPropagate, kDecideFirst, kDecideAll, kCertify };

Bound BoundOf(const Precondition& precondition, const UncertainWorld& world,
              algebra::BoundRequest request) {
  request.limit = precondition.limit;
  return precondition.relation == Relation::kLess
             ? BoundAbove(precondition.expression, world.constraints(), request)
             : BoundBelow(precondition.expression, world.constraints(), request);
}

CertifiedPrecondition ClaimOf(const Precondition& precondition, const Bound& bound) {
  const bool less = precondition.relation == Relation::kLess;
  return {.condition = precondition.condition,
          .meaning = precondition.meaning,
          .expression = {},
          .relation = precondition.relation,
          .limit = precondition.limit,
          .bound = bound.value,
          .margin = less ? precondition.limit - bound.value : bound.value - precondition.limit,
          .gap = bound.gap,
          .method = std::string(algebra::Name(bound.method))};
}

// Returns the claim, if quick bounds (algebra/methods/glance.h) tell whether it holds.
std::optional<CertifiedPrecondition> Seen(const Precondition& precondition,
                                          const algebra::Glance& glance) {
  const bool less = precondition.relation == Relation::kLess;
  const double limit = precondition.limit;
  const bool holds = less ? glance.bound < limit : glance.bound > limit;
  const bool fails = less ? glance.attained >= limit : glance.attained <= limit;
  if (!holds && !fails) return std::nullopt;
  return ClaimOf(precondition, {.value = glance.bound});
}

class StepCertifier {
 public:
  StepCertifier(UncertainWorld& world, Effort effort, const algebra::BoundRequest& request,
                const plan::Strategy* strategy)
      : world_(world), effort_(effort), request_(request), strategy_(strategy) {}

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

  void Certify(const plan::Action& action) {
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

 private:
  void Pickup(const plan::Action& pickup) {
    const ManipulatorError draw = world_.DrawManipulator();
    const HeldError held = RequireGrasp(pickup.part, pickup.hold, draw, false);
    RequireHolding(pickup.part, pickup.hold, held, Turning::kNone);
    world_.SetHeld(pickup.part, held);
    After(pickup.part, PossibleGrasp(held, draw, world_.propagation()));
  }

  void Squeeze(const plan::Action& squeeze) {
    const ManipulatorError draw = world_.DrawManipulator();
    const HeldError held = RequireGrasp(squeeze.part, squeeze.hold, draw, true);
    const BeliefShift shift = world_.shift(squeeze.part);
    const Expression height = world_.resting(squeeze.part).displacement[2];
    world_.SetHeld(squeeze.part, held);
    RestingError error =
        Release(world_, squeeze.part, squeeze.hold, PossibleGrasp(held, draw, world_.propagation()),
                draw, world_.X_WorldPart(squeeze.part));
    error.displacement[2] = height;  // the part stays on the table
    world_.SetResting(squeeze.part, world_.X_WorldPart(squeeze.part), error, shift);
    After(squeeze.part);
  }

  void Putdown(const plan::Action& putdown) {
    const ManipulatorError draw = world_.DrawManipulator();
    const Transform grasp = PossibleGrasp(world_.held(), draw, world_.propagation());
    const Pose& X_WorldPart = putdown.place.X_WorldPart;
    const Expression table = world_.DrawTableHeight(putdown.part);
    Before(putdown.part, grasp);
    RestingError error = Release(world_, putdown.part, putdown.hold, grasp, draw, X_WorldPart);
    const Expression farther = error.displacement[2] - table;
    error.displacement[2] = table;
    if (decides()) {
      Require(LandingPreconditions(world_, putdown.part, putdown.hold, grasp, X_WorldPart, table,
                                   error));
      RequireHolding(putdown.part, putdown.hold, world_.held(), Turning::kAny);
    }
    RequireSound([&] {
      return HandClearanceAtPutdown(world_, {putdown.part, putdown.hold, draw, X_WorldPart,
                                             -Vector3::UnitZ(), farther, error});
    });
    RequireSound([&] {
      return StandingPreconditions(world_, putdown.part, putdown.hold, draw, X_WorldPart, error, 0);
    });
    world_.SetResting(putdown.part, X_WorldPart, error, {});
    After(putdown.part);
  }

  void Assemble(const plan::Action& assemble) {
    const domain::Mating& mating = world_.problem().mating(assemble.mating);
    const ManipulatorError draw = world_.DrawManipulator();
    const Transform grasp = PossibleGrasp(world_.held(), draw, world_.propagation());
    const Pose X_WorldHeld = world_.X_WorldPart(mating.fixed) * mating.X_FixedHeld;
    Before(mating.held, grasp);
    Before(mating.fixed);
    if (decides()) {
      Require(MatingPreconditions(world_, assemble.mating, assemble.hold, grasp));
      if (decides() && strategy_ != nullptr) {
        Require(TipPreconditions(world_, assemble.mating, assemble.hold, grasp, *strategy_));
      }
      RequireHolding(mating.held, assemble.hold, world_.held(), Turning::kAny);
    }
    const RestingError error =
        strategy_ != nullptr ? LedToSeat(world_, assemble.mating)
                             : ReleaseInSeat(world_, assemble.mating, assemble.hold, grasp, draw);
    RequireClearMating(assemble, draw, grasp, error);
    RequireStanding(assemble, draw, X_WorldHeld, error);
    if (strategy_ == nullptr) DragFixed(world_, assemble.mating, assemble.hold, draw);
    world_.SetResting(mating.held, X_WorldHeld, error,
                      world_.ShiftAt(mating.fixed, X_WorldHeld.translation()));
    After(mating.held);
    After(mating.fixed);
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

  HeldError RequireGrasp(PartId part, const plan::Hold& hold, const ManipulatorError& draw,
                         bool opens_again) {
    Before(part);
    const HeldError held = ClosePads(world_, part, hold, draw);
    if (decides()) {
      Require(GraspPreconditions(world_, part, hold, draw, held));
    }
    RequireSound([&] { return HandClearanceAtGrasp(world_, part, hold, draw, held, opens_again); });
    RequireSound([&] { return ClosingPreconditions(world_, part, hold, draw, held); });
    return held;
  }

  void RequireHolding(PartId part, const plan::Hold& hold, const HeldError& held, Turning turning) {
    RequireSound([&] { return HoldingPreconditions(world_, part, hold, held, turning); });
  }

  // Requires conditions that the paper does not ask for.
  template <class Conditions>
  void RequireSound(const Conditions& conditions) {
    if (!decides() || world_.propagation() == Propagation::kPaper) return;
    Require(conditions());
  }

  // Requires that the mated part and the fixed part keep standing.
  void RequireStanding(const plan::Action& assemble, const ManipulatorError& draw,
                       const Pose& X_WorldHeld, const RestingError& released) {
    const domain::Problem& problem = world_.problem();
    const domain::Mating& mating = problem.mating(assemble.mating);
    RequireSound([&] {
      const double play =
          strategy_ == nullptr ? 0 : PlayInSeat(problem, mating, problem.tolerances.clearance).turn;
      return StandingPreconditions(world_, mating.held, assemble.hold, draw, X_WorldHeld, released,
                                   play);
    });
    RequireSound([&] { return FixedPreconditions(world_, assemble.mating, released, strategy_); });
  }

  // Requires clearance for the hand that opens, and for the held part on its way.
  void RequireClearMating(const plan::Action& assemble, const ManipulatorError& draw,
                          const Transform& grasp, const RestingError& released) {
    const domain::Mating& mating = world_.problem().mating(assemble.mating);
    RequireSound([&] {
      const MatingEnd end = MatingEndOf(world_, assemble.mating, assemble.hold, grasp);
      const Pose X_WorldHeld = world_.X_WorldPart(mating.fixed) * mating.X_FixedHeld;
      return HandClearanceAtMating(
          world_, assemble.mating,
          {mating.held, assemble.hold, draw, X_WorldHeld, end.motion, end.farther, released},
          strategy_ != nullptr);
    });
    RequireSound([&] { return PassingPreconditions(world_, assemble, grasp, strategy_); });
  }

  void Require(const std::vector<Precondition>& preconditions) {
    for (const Precondition& precondition : preconditions) {
      if (!decides()) return;
      CertifiedPrecondition claim = certifies() ? Certified(precondition) : Decided(precondition);
      if (!claim.holds()) {
        certified_.unproved.push_back({claim, precondition.expression, precondition.neighbour});
      }
      if (certifies()) certified_.certificate.preconditions.push_back(std::move(claim));
    }
  }

  // A claim that quick bounds prove is proved, even if the bounding methods stopped with a looser
  // bound at the wanted gap.
  CertifiedPrecondition Certified(const Precondition& precondition) {
    if (std::optional<CertifiedPrecondition> claim = ProvedToFirstOrder(precondition)) {
      return *std::move(claim);
    }
    Bound bound = BoundOf(precondition, world_, request_);
    CertifiedPrecondition claim = ClaimOf(precondition, bound);
    if (!claim.holds()) {
      const std::optional<CertifiedPrecondition> seen = AtAGlance(precondition);
      if (seen && seen->holds()) {
        bound = {.value = seen->bound,
                 .method = algebra::BoundingMethod::kCentred,
                 .gap = bound.gap,
                 .at = std::move(bound.at)};
        claim = ClaimOf(precondition, bound);
      }
    }
    Detail(precondition, bound, claim);
    return claim;
  }

  // First-order bounds prove most claims, and the bounding methods need not run for these claims.
  // The bounding methods would stop at the first method that proves the claim, and its bound would
  // be looser.
  std::optional<CertifiedPrecondition> ProvedToFirstOrder(const Precondition& precondition) {
    if (request_.highest < algebra::BoundingMethod::kCentred) return std::nullopt;
    const bool less = precondition.relation == Relation::kLess;
    const Bound bound = less ? world_.FirstOrderAbove(precondition.expression)
                             : world_.FirstOrderBelow(precondition.expression);
    CertifiedPrecondition claim = ClaimOf(precondition, bound);
    if (!claim.holds()) return std::nullopt;
    Detail(precondition, bound, claim);
    return claim;
  }

  CertifiedPrecondition Decided(const Precondition& precondition) const {
    std::optional<CertifiedPrecondition> seen = AtAGlance(precondition);
    if (seen) return *std::move(seen);
    return ClaimOf(precondition, BoundOf(precondition, world_, request_));
  }

  // Quick bounds decide most claims, although they are looser. They prove what the centred bounding
  // method proves. If the request allows only weaker methods, quick bounds are not used, because
  // they could prove a claim that the certificate does not prove.
  std::optional<CertifiedPrecondition> AtAGlance(const Precondition& precondition) const {
    if (request_.highest < algebra::BoundingMethod::kCentred) return std::nullopt;
    const auto& [condition, meaning, expression, relation, limit, neighbour] = precondition;
    const bool less = relation == Relation::kLess;
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

  UncertainWorld& world_;
  Effort effort_;
  const algebra::BoundRequest& request_;
  const plan::Strategy* strategy_;
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
                          const algebra::BoundRequest& request, const plan::Strategy* strategy) {
  StepCertifier certifier(world, Effort::kCertify, request, strategy);
  certifier.Certify(action);
  CertifiedStep step = certifier.Take();
  step.certificate.not_needed = plan::NotNeededIn(step.certificate.preconditions, action, strategy,
                                                  world.propagation() == Propagation::kPaper);
  return step;
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
  StepCertifier certifier(world, effort, request, strategy);
  certifier.Certify(action);
  return certifier.Take().unproved;
}

Unproved AsCertified(Unproved unproved, const UncertainWorld& world,
                     const algebra::BoundRequest& request) {
  const Precondition precondition = {.condition = unproved.claim.condition,
                                     .meaning = unproved.claim.meaning,
                                     .expression = unproved.expression,
                                     .relation = unproved.claim.relation,
                                     .limit = unproved.claim.limit};
  unproved.claim = ClaimOf(precondition, BoundOf(precondition, world, request));
  return unproved;
}

void Propagate(UncertainWorld& world, const plan::Action& action, const plan::Strategy* strategy) {
  const algebra::BoundRequest none;
  StepCertifier certifier(world, Effort::kPropagate, none, strategy);
  certifier.Certify(action);
}

plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part, const Transform& X_ToolGrasp) {
  const SymbolicVector& offset = X_ToolGrasp.translation;
  return {.part = part,
          .in_hand = true,
          .x = world.TightRangeOf(offset[0]),
          .y = world.TightRangeOf(offset[1]),
          .z = world.TightRangeOf(offset[2]),
          .theta = algebra::operator+(world.TightRangeOf(world.held().skew),
                                      world.problem().gripper_error.theta),
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
