#include "sim/enact/mishap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/check.h"
#include "planner/domain/resting.h"
#include "planner/plan/tool_route.h"

namespace assay::enact {
namespace {

using geometry::Vector3;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAway = 0.06;  // metres between a part and where it should be
constexpr double kGap = 0.02;   // metres to other parts, of what was moved
constexpr Interval kTurn = {25 * kDegree, 45 * kDegree};
constexpr Interval kPastTheRim = {0.0008, 0.0015};  // metres, beyond the play
// Of a slip, between a tolerance and the greatest that a guarded move feels.
constexpr Interval kSlip = {0.3, 0.7};

double Draw(const Interval& range, RandomStream& random) {
  return random.Uniform(range.low, range.high);
}

Vector3 Horizontal(double length, double angle) {
  return {length * std::cos(angle), length * std::sin(angle), 0};
}

// Makes the mishap before one step of a plan.
class MishapMaker {
 public:
  MishapMaker(const domain::Problem& problem, const StepError& error, RandomStream& random)
      : problem_(problem), random_(random), mishap_{.action = error.step, .error = error.error} {}

  std::variant<Mishap, std::string> Make(const plan::Action& action,
                                         const plan::Verification& check) {
    const bool is_above = check.below != mishap_.error;
    const auto* assemble = std::get_if<plan::Assemble>(&action);
    mishap_.part = plan::PartOf(problem_, action);
    if (check.quantity == domain::MeasuredQuantity::kGripperOpening) {
      if (is_above) {
        mishap_.turn = Draw(kTurn, random_);
      } else {
        TakeAway();
      }
      return mishap_;
    }
    if (assemble != nullptr && is_above) {
      MoveAside();
      return mishap_;
    }
    const double guarded = problem_.workcell->rules().guarded_travel;
    if (check.tolerance >= guarded) {
      return fmt::format(
          "what {} tells is {} by more than {:.1f} mm, and a guarded move ends within {:.1f} mm",
          mishap_.error, is_above ? "above" : "below", 1e3 * check.tolerance, 1e3 * guarded);
    }
    if (assemble != nullptr) {
      TakeAway();
    } else {
      const double slip = std::lerp(check.tolerance, guarded, Draw(kSlip, random_));
      mishap_.way = (is_above ? -slip : slip) * Vector3::UnitZ();
    }
    return mishap_;
  }

 private:
  // To the first free place on the table around where it is.
  void TakeAway() {
    const domain::Part& part = problem_.part(mishap_.part);
    const double reach = kAway + 2 * Radius(part);
    constexpr int kDirections = 16;
    const int first = random_.Index(kDirections);
    for (int i = 0; i < kDirections; ++i) {
      mishap_.way = Horizontal(reach, 2 * std::numbers::pi * (first + i) / kDirections);
      if (IsFree(geometry::Translation(mishap_.way) * part.X_WorldPart)) return;
    }
  }

  static double Radius(const domain::Part& part) {
    double radius = 0;
    for (const Vector3& vertex : part.model->hull().vertices) {
      radius = std::max(radius, (part.X_WorldPart.linear() * vertex).head<2>().norm());
    }
    return radius;
  }

  bool IsFree(const exec::Pose& X_WorldPart) const {
    if (!domain::OnTable(problem_, mishap_.part, X_WorldPart)) return false;
    const domain::PartModel& model = *problem_.part(mishap_.part).model;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (PartId(p) == mishap_.part) continue;
      const domain::Part& other = problem_.parts[p];
      const double gap =
          Distance(model.shape(), X_WorldPart, other.model->shape(), other.X_WorldPart);
      if (gap < kGap) return false;
    }
    return true;
  }

  void MoveAside() {
    const double play = problem_.part(mishap_.part).model->clearance();
    mishap_.way = Horizontal(play + Draw(kPastTheRim, random_),
                             random_.Uniform(-std::numbers::pi, std::numbers::pi));
  }

  const domain::Problem& problem_;
  RandomStream& random_;
  Mishap mishap_;
};

// The verification that signals it.
const plan::Verification& Signalling(const plan::Plan& plan, plan::StepId step,
                                     const std::string& error) {
  const auto found = std::ranges::find_if(plan.verifications, [&](const auto& check) {
    return check.step == step && (check.below == error || check.above == error);
  });
  ASSAY_CHECK(found != plan.verifications.end(), "no verification signals {}", error);
  return *found;
}

}  // namespace

std::vector<StepError> ErrorsOf(const PlannedWorlds& planned, int world) {
  std::vector<StepError> errors;
  const plan::Plan* const plan = planned.PlanOf(world);
  for (const auto& [name, action] : planned.assembly.knowledge.actions) {
    if (action.kind != assembly::KnowledgeAction::Kind::kStep) continue;
    if (&planned.assembly.plans[action.plan].plan != plan) continue;
    for (const plan::Verification& check : plan->verifications) {
      if (check.step != action.step) continue;
      for (const std::string& error : {check.below, check.above}) {
        if (!error.empty()) errors.push_back({name, error});
      }
    }
  }
  return errors;
}

std::variant<Mishap, std::string> MishapFor(const PlannedWorlds& planned, int world,
                                            const StepError& error, RandomStream& random) {
  const plan::Plan& plan = *planned.PlanOf(world);
  const plan::StepId step = planned.assembly.knowledge.actions.at(error.step).step;
  return MishapMaker(planned.worlds[world], error, random)
      .Make(plan.step(step).action, Signalling(plan, step, error.error));
}

}  // namespace assay::enact
