#include "tests/sim/check/mutation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "planner/base/check.h"

namespace assay::check {
namespace {

using plan::ErrorSet;
using uncertainty::Expression;

const plan::ErrorComponent& ComponentAt(int index) {
  return plan::ErrorComponents()[static_cast<std::size_t>(index)];
}

Expression& ComponentOf(uncertainty::HeldError& held, int component) {
  const std::array components = {&held.x, &held.y, &held.z, &held.skew, &held.tip, &held.twist};
  return *components[static_cast<std::size_t>(component)];
}
Expression& ComponentOf(uncertainty::RestingError& resting, int component) {
  return component == 3 ? resting.theta : resting.displacement[static_cast<std::size_t>(component)];
}

void Scale(double factor, domain::PartId part, int component, uncertainty::UncertainWorld& world) {
  if (world.in_hand() == part) {
    uncertainty::HeldError held = world.held();
    ComponentOf(held, component) = factor * ComponentOf(held, component);
    world.SetHeld(part, held);
  } else {
    uncertainty::RestingError resting = world.resting_in_world(part);
    ComponentOf(resting, component) = factor * ComponentOf(resting, component);
    world.SetBelieved(part, world.shift(part), resting);
  }
}

void Halve(domain::PartId part, int component, std::vector<ErrorSet>& sets) {
  for (ErrorSet& set : sets) {
    if (set.part != part) continue;
    Interval& range = set.*ComponentAt(component).range;
    range = {range.low / 2, range.high / 2};
  }
}

// Moves the limit so that the margin grows by a third.
void MoveLimit(plan::CertifiedPrecondition& claim) {
  if (!claim.holds()) return;
  const double third = claim.margin / 3;
  claim.limit += claim.relation == plan::Relation::kLess ? third : -third;
  claim.margin += third;
}

// Applies the lie to the world and the certificate after the mutated step.
void Lied(const Mutation& mutation, plan::Certificate& certificate,
          uncertainty::UncertainWorld& world) {
  switch (mutation.lie) {
    case Lie::kHalvedSet:
      Scale(0.5, mutation.part, mutation.component, world);
      Halve(mutation.part, mutation.component, certificate.after);
      return;
    case Lie::kHalvedPromise:
      for (const int component : {0, 1, 2, 3}) {
        Scale(0.5, mutation.part, component, world);
        Halve(mutation.part, component, certificate.after);
      }
      return;
    case Lie::kErrorNotCarried:
      Scale(0, mutation.part, mutation.component, world);
      return;
    case Lie::kMovedLimit:
      for (plan::CertifiedPrecondition& claim : certificate.preconditions) {
        if (claim.condition == mutation.condition) MoveLimit(claim);
      }
      return;
    case Lie::kForgottenError:
    case Lie::kAsPublished:
      return;
  }
}

domain::Problem ProblemWith(const Mutation& mutation, domain::Problem problem) {
  if (mutation.lie != Lie::kForgottenError) return problem;
  domain::PoseError& error =
      mutation.part.IsNone() ? problem.gripper_error : problem.parts[mutation.part.index()].error;
  const std::array coordinates = {&error.x, &error.y, &error.z, &error.theta};
  *coordinates[static_cast<std::size_t>(mutation.component)] = {0, 0};
  return problem;
}

bool HasWidth(const Interval& range) { return range.high > range.low; }

void AddOfStep(const Certified& certified, plan::StepId step, bool is_last,
               std::vector<Mutation>& mutations) {
  const plan::PlannedStep& planned = certified.plan.step(step);
  const bool looks = planned.action.Is(domain::kSense);
  for (const ErrorSet& set : planned.certificate.after) {
    if (looks) mutations.push_back({Lie::kHalvedPromise, step, set.part, 0});
    for (int c = 0; c < (set.in_hand ? 6 : 4); ++c) {
      if (!HasWidth(set.*ComponentAt(c).range)) continue;
      mutations.push_back({Lie::kHalvedSet, step, set.part, c});
      if (!is_last) mutations.push_back({Lie::kErrorNotCarried, step, set.part, c});
    }
  }
  std::vector<plan::Condition> proved;
  for (const plan::CertifiedPrecondition& claim : planned.certificate.preconditions) {
    if (claim.holds() && std::ranges::count(proved, claim.condition) == 0) {
      proved.push_back(claim.condition);
      mutations.push_back({.lie = Lie::kMovedLimit, .step = step, .condition = claim.condition});
    }
  }
}

void AddForgotten(const domain::PoseError& error, domain::PartId part,
                  std::vector<Mutation>& mutations) {
  const std::array ranges = {error.x, error.y, error.z, error.theta};
  for (int c = 0; c < 4; ++c) {
    if (HasWidth(ranges[static_cast<std::size_t>(c)])) {
      mutations.push_back({Lie::kForgottenError, plan::StepId::None(), part, c});
    }
  }
}

}  // namespace

std::string_view Name(Lie lie) {
  switch (lie) {
    case Lie::kHalvedSet:
      return "halved set";
    case Lie::kHalvedPromise:
      return "halved promise of a sensor";
    case Lie::kErrorNotCarried:
      return "error not carried over";
    case Lie::kForgottenError:
      return "forgotten error";
    case Lie::kAsPublished:
      return "as published";
    case Lie::kMovedLimit:
      return "limit moved by a third";
  }
  ASSAY_CHECK(false, "a lie that the switch does not know");
  return {};
}

std::string Mutation::Text(const Certified& certified) const {
  const std::string of = part.IsNone() ? "the hand" : certified.problem.parts[part.index()].name;
  const std::string where =
      step.IsNone() ? "" : fmt::format(" after {}", certified.plan.step(step).name);
  if (lie == Lie::kAsPublished) return std::string(Name(lie));
  if (lie == Lie::kMovedLimit) {
    return fmt::format("{}: {} of {}", Name(lie), condition->name(),
                       certified.plan.step(step).name);
  }
  return fmt::format("{}: {} of {}{}", Name(lie), ComponentAt(component).name, of, where);
}

std::vector<Mutation> MutationsOf(const Certified& certified) {
  std::vector<Mutation> mutations = {{.lie = Lie::kAsPublished}};
  AddForgotten(certified.problem.gripper_error, domain::PartId::None(), mutations);
  for (std::size_t p = 0; p < certified.problem.parts.size(); ++p) {
    AddForgotten(certified.problem.parts[p].error, domain::PartId(p), mutations);
  }
  const std::vector<plan::StepId> order = certified.plan.ExecutionOrder();
  for (const plan::StepId step : order) {
    AddOfStep(certified, step, step == order.back(), mutations);
  }
  return mutations;
}

plan::Plan CertifiedWith(const Mutation& mutation, const Certified& certified) {
  const domain::Problem problem = ProblemWith(mutation, certified.problem);
  using enum uncertainty::Propagation;
  uncertainty::UncertainWorld world(problem, mutation.lie == Lie::kAsPublished ? kPaper : kSound);
  plan::Plan plan = certified.plan;
  for (const plan::StepId id : plan.ExecutionOrder()) {
    plan::PlannedStep& step = plan.steps[id.index()];
    const plan::Strategy* strategy = step.strategy ? &*step.strategy : nullptr;
    step.certificate = uncertainty::CertifyStep(world, step.action, {}, strategy).certificate;
    if (id == mutation.step) Lied(mutation, step.certificate, world);
  }
  return plan;
}

}  // namespace assay::check
