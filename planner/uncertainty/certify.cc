#include "planner/uncertainty/certify.h"

#include <algorithm>
#include <cmath>

#include "planner/algebra/simplify.h"
#include "planner/algebra/text.h"
#include "planner/base/check.h"
#include "planner/uncertainty/release.h"
#include "planner/uncertainty/sensing.h"
#include "planner/uncertainty/squeezing.h"

namespace assay::uncertainty {
namespace {

using algebra::Bound;
using plan::CertifiedPrecondition;
using plan::Relation;

class StepCertifier {
 public:
  // Without a request nothing is certified, only propagated.
  StepCertifier(UncertainWorld& world, const algebra::BoundRequest* request)
      : world_(world), request_(request) {}

  CertifiedStep Take() {
    certified_.certificate.variables = world_.VariablesIn(expressions_);
    return std::move(certified_);
  }

  void operator()(const plan::Pickup& pickup) {
    const ManipulatorError draw = world_.DrawManipulator();
    const HeldError held = RequireGrasp(pickup.part, pickup.hold, draw);
    world_.SetHeld(pickup.part, held);
    After(pickup.part, PossibleGrasp(held, draw, world_.propagation()));
  }

  void operator()(const plan::Squeeze& squeeze) {
    const ManipulatorError draw = world_.DrawManipulator();
    const HeldError held = RequireGrasp(squeeze.part, squeeze.hold, draw);
    const Expression height = world_.resting(squeeze.part).displacement[2];
    world_.SetHeld(squeeze.part, held);
    RestingError error =
        Release(world_, squeeze.part, squeeze.hold, PossibleGrasp(held, draw, world_.propagation()),
                draw, world_.X_WorldPart(squeeze.part));
    error.displacement[2] = height;  // it stays on the table
    world_.Nudge(squeeze.part, error);
    After(squeeze.part);
  }

  void operator()(const plan::Putdown& putdown) {
    const ManipulatorError draw = world_.DrawManipulator();
    const Transform grasp = PossibleGrasp(world_.held(), draw, world_.propagation());
    const Pose& X_WorldPart = putdown.to.X_WorldPart;
    const Expression table = world_.DrawTableHeight(putdown.part);
    Before(putdown.part, grasp);
    if (certifies()) {
      Require(LandingPreconditions(world_, putdown.part, putdown.hold, grasp, X_WorldPart, table));
    }
    RestingError error = Release(world_, putdown.part, putdown.hold, grasp, draw, X_WorldPart);
    error.displacement[2] = table;
    world_.SetResting(putdown.part, X_WorldPart, error);
    After(putdown.part);
  }

  void operator()(const plan::Assemble& assemble) {
    const domain::Mating& mating = world_.problem().mating(assemble.mating);
    const ManipulatorError draw = world_.DrawManipulator();
    const Transform grasp = PossibleGrasp(world_.held(), draw, world_.propagation());
    Before(mating.held, grasp);
    Before(mating.fixed);
    if (certifies()) {
      Require(MatingPreconditions(world_, assemble.mating, assemble.hold, grasp));
    }
    const Pose X_WorldHeld = world_.X_WorldPart(mating.fixed) * mating.X_FixedHeld;
    world_.SetResting(mating.held, X_WorldHeld,
                      Release(world_, mating.held, assemble.hold, grasp, draw, X_WorldHeld));
    After(mating.held);
    After(mating.fixed);
  }

  void operator()(const plan::Sense& sense) {
    Before(sense.part);
    ApplySensing(world_, sense.part, sense.sensor);
    After(sense.part);
  }

 private:
  bool certifies() const { return request_ != nullptr; }

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

  HeldError RequireGrasp(PartId part, const plan::Hold& hold, const ManipulatorError& draw) {
    Before(part);
    const HeldError held = ClosePads(world_, part, hold, draw);
    if (certifies()) Require(GraspPreconditions(world_, part, hold, draw, held));
    return held;
  }

  void Require(const std::vector<Precondition>& preconditions) {
    const algebra::ConstraintSet box = world_.constraints();
    for (const Precondition& precondition : preconditions) {
      expressions_.push_back(precondition.expression);
      CertifiedPrecondition claim = Certify(precondition, box);
      if (!claim.holds()) {
        certified_.unproved.push_back({claim, world_.PartsIn(precondition.expression)});
      }
      certified_.certificate.preconditions.push_back(std::move(claim));
    }
  }

  CertifiedPrecondition Certify(const Precondition& precondition,
                                const algebra::ConstraintSet& box) const {
    const bool less = precondition.relation == Relation::kLess;
    algebra::BoundRequest request = *request_;
    request.limit = precondition.limit;
    const Bound bound = less ? BoundAbove(precondition.expression, box, request)
                             : BoundBelow(precondition.expression, box, request);
    CertifiedPrecondition claim = {
        .condition = precondition.condition,
        .meaning = precondition.meaning,
        .expression = algebra::Text(precondition.expression),
        .relation = precondition.relation,
        .limit = precondition.limit,
        .bound = bound.value,
        .margin = less ? precondition.limit - bound.value : bound.value - precondition.limit,
        .gap = bound.gap,
        .rung = std::string(algebra::Name(bound.rung))};
    if (bound.at.empty()) return claim;
    for (const algebra::VariableId v : algebra::VariablesOf(precondition.expression)) {
      const double x = bound.at[v.index()];
      claim.worst.push_back({world_.NameOf(v), {x, x}});
    }
    return claim;
  }

  UncertainWorld& world_;
  const algebra::BoundRequest* request_;
  CertifiedStep certified_;
  std::vector<Expression> expressions_;
};

}  // namespace

double CertifiedStep::Violation() const {
  double violation = 0;
  for (const Unproved& unmet : unproved) violation -= unmet.claim.margin;
  return violation;
}

CertifiedStep CertifyStep(UncertainWorld& world, const plan::Action& action,
                          const algebra::BoundRequest& request) {
  StepCertifier certifier(world, &request);
  std::visit(certifier, action);
  return certifier.Take();
}

void Propagate(UncertainWorld& world, const plan::Action& action) {
  StepCertifier certifier(world, nullptr);
  std::visit(certifier, action);
}

plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part, const Transform& X_ToolGrasp) {
  const SymbolicVector offset = algebra::Simplify(X_ToolGrasp.translation);
  return {.part = part,
          .in_hand = true,
          .x = world.RangeOf(offset[0]),
          .y = world.RangeOf(offset[1]),
          .z = world.RangeOf(offset[2]),
          .theta = world.problem().gripper_error.theta};
}

plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part) {
  const RestingError& error = world.resting(part);
  return {.part = part,
          .in_hand = false,
          .x = world.RangeOf(error.displacement[0]),
          .y = world.RangeOf(error.displacement[1]),
          .z = world.RangeOf(error.displacement[2]),
          .theta = world.RangeOf(error.theta)};
}

}  // namespace assay::uncertainty
