#include "sim/execution/hidden_worlds/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/check.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "planner/plan/data/tool_route.h"

namespace assay::execution {
namespace {

using geometry::Vector3;

constexpr double kAway = 0.06;   // metres that a part is moved away, beyond twice its radius
constexpr double kGap = 0.02;    // metres between a moved part and other parts
constexpr double kFlush = 1e-6;  // metres, the tolerance for faces in one plane
constexpr Interval kPastTheRim = {0.0008, 0.0015};  // metres beyond the clearance
// The length of a slip as a share of the way from the verification's tolerance (0) to the greatest
// travel of a guarded move (1).
constexpr Interval kSlip = {0.3, 0.7};

double Draw(const Interval& range, RandomStream& random) {
  return random.Uniform(range.low, range.high);
}

Vector3 Horizontal(double length, double angle) {
  return {length * std::cos(angle), length * std::sin(angle), 0};
}

// Makes the fault before one step of a plan.
class FaultMaker {
 public:
  FaultMaker(const domain::Problem& problem, const StepError& error, RandomStream& random)
      : problem_(problem), random_(random), fault_{.action = error.step, .error = error.error} {}

  std::variant<Fault, std::string> Make(const plan::Action& action,
                                        const plan::Verification& check) {
    fault_.part = plan::PlacedPart(problem_, action);
    return check.quantity == domain::MeasuredQuantity::kGripperOpening ? OfOpening(action, check)
                                                                       : OfHeight(action, check);
  }

 private:
  bool IsAbove(const plan::Verification& check) const { return check.below != fault_.error; }

  std::string Wanted(const plan::Verification& check) const {
    return fmt::format("{} is signalled if the measurement is too {} by more than {:.1f} mm",
                       fault_.error, IsAbove(check) ? "great" : "small", 1e3 * check.tolerance);
  }

  std::variant<Fault, std::string> OfOpening(const plan::Action& action,
                                             const plan::Verification& check) {
    const bool takes = action.kind->leaves == domain::Leaves::kInHand;
    if (!IsAbove(check)) {
      const domain::Part& part = problem_.part(fault_.part);
      TakeAway(takes ? action.place.X_WorldPart : part.X_WorldPart);
      return fault_;
    }
    if (!takes) {
      return fmt::format("{}, but nothing opens pads that have closed", Wanted(check));
    }
    const double opening = TurnOntoCorners(action);
    const double greatest = problem_.workcell->gripper().max_opening();
    if (opening > action.hold.width + check.tolerance && opening < greatest) return fault_;
    return fmt::format("{}, but {} that is turned opens the pads to {:.1f} mm, of {:.1f} mm",
                       Wanted(check), problem_.part(fault_.part).name, 1e3 * opening,
                       1e3 * greatest);
  }

  // Turns the part about the grasped point until the pads meet two opposite corners of it. The line
  // between these corners then lies in the closing direction, so that the closing pads do not turn
  // the part back. Returns the opening that is left between the pads, in metres.
  double TurnOntoCorners(const plan::Action& pickup) {
    const double width = pickup.hold.width;
    const double length = LengthBetweenPads(pickup);
    fault_.turn = (random_.Index(2) == 0 ? 1 : -1) * std::atan2(length, width);
    const Vector3 grasped =
        pickup.place.X_WorldPart.linear() * pickup.hold.X_PartTool.translation();
    fault_.way = grasped - geometry::RotationZ(fault_.turn) * grasped;
    return std::hypot(length, width);
  }

  // Returns the horizontal length of the faces that the pads should meet, in metres. Neither the
  // lean of the hand nor that of the part changes it.
  double LengthBetweenPads(const plan::Action& pickup) const {
    const geometry::Matrix3 R_PartTool = pickup.hold.X_PartTool.linear();
    const Vector3 up = pickup.place.X_WorldPart.linear().row(2);  // in the part's frame
    const Vector3 horizontal = up.cross(Vector3(R_PartTool.col(1)));
    int axis = 0;
    horizontal.cwiseAbs().maxCoeff(&axis);
    Interval along = {0, 0};
    const auto is_met = [&](const Vector3& from_tool) {
      return std::abs(from_tool.dot(R_PartTool.col(1))) > pickup.hold.width / 2 - kFlush;
    };
    for (const domain::Face& face : problem_.part(pickup.part).model->faces()) {
      for (const geometry::Polygon& patch : face.patches) {
        for (const geometry::Vector2& corner : patch) {
          const Vector3 from_tool = face.X_PartFace * Vector3(corner.x(), corner.y(), 0) -
                                    pickup.hold.X_PartTool.translation();
          if (!is_met(from_tool)) continue;
          along = {std::min(along.low, from_tool[axis]), std::max(along.high, from_tool[axis])};
        }
      }
    }
    return (along.high - along.low) / std::abs(horizontal[axis]);
  }

  std::variant<Fault, std::string> OfHeight(const plan::Action& action,
                                            const plan::Verification& check) {
    const bool is_assembly = !action.mating.IsNone();
    if (is_assembly && IsAbove(check)) {
      MoveAside();
      return fault_;
    }
    const double guarded = problem_.workcell->rules().guarded_travel;
    if (check.tolerance >= guarded) {
      return fmt::format("{}, but a guarded move ends within {:.1f} mm", Wanted(check),
                         1e3 * guarded);
    }
    if (!is_assembly) {
      const double slip = std::lerp(check.tolerance, guarded, Draw(kSlip, random_));
      fault_.way = (IsAbove(check) ? -slip : slip) * Vector3::UnitZ();
      return fault_;
    }
    // The height at which the guarded move should end is uncertain by this much.
    const double doubt = check.tolerance - ToleranceWithoutDoubt(check);
    if (check.tolerance + doubt >= guarded) {
      return fmt::format(
          "{}, but a guarded move ends within {:.1f} mm of a height that may be off "
          "by {:.1f} mm",
          Wanted(check), 1e3 * guarded, 1e3 * doubt);
    }
    TakeAway(problem_.part(fault_.part).X_WorldPart);
    return fault_;
  }

  // Returns the tolerance that the workcell states. The plan's tolerance includes the errors that
  // the plan could not rule out.
  double ToleranceWithoutDoubt(const plan::Verification& check) const {
    const auto& known = problem_.workcell->uncertainty_operations().verifications;
    const auto found = std::ranges::find(known, check.name, &domain::VerificationTemplate::name);
    return found == known.end() ? check.tolerance : found->tolerance;
  }

  // Moves the part to the first free place on the table in a circle around it.
  void TakeAway(const Pose& X_WorldPart) {
    const double reach = kAway + 2 * Radius(X_WorldPart);
    constexpr int kDirections = 16;
    const int first = random_.Index(kDirections);
    for (int i = 0; i < kDirections; ++i) {
      fault_.way = Horizontal(reach, 2 * std::numbers::pi * (first + i) / kDirections);
      if (IsFree(geometry::Translation(fault_.way) * X_WorldPart)) return;
    }
  }

  double Radius(const Pose& X_WorldPart) const {
    double radius = 0;
    for (const Vector3& vertex : problem_.part(fault_.part).model->corners()) {
      radius = std::max(radius, (X_WorldPart.linear() * vertex).head<2>().norm());
    }
    return radius;
  }

  bool IsFree(const Pose& X_WorldPart) const {
    if (!domain::OnTable(problem_, fault_.part, X_WorldPart)) return false;
    const domain::PartModel& model = *problem_.part(fault_.part).model;
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (PartId(p) == fault_.part) continue;
      const domain::Part& other = problem_.parts[p];
      const double gap =
          Distance(model.shape(), X_WorldPart, other.model->shape(), other.X_WorldPart);
      if (gap < kGap) return false;
    }
    return true;
  }

  void MoveAside() {
    const double play = problem_.part(fault_.part).model->clearance();
    fault_.way = Horizontal(play + Draw(kPastTheRim, random_),
                            random_.Uniform(-std::numbers::pi, std::numbers::pi));
  }

  const domain::Problem& problem_;
  RandomStream& random_;
  Fault fault_;
};

// Returns the verification of the step that signals the error.
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

std::variant<Fault, std::string> FaultFor(const PlannedWorlds& planned, int world,
                                          const StepError& error, RandomStream& random) {
  const plan::Plan& plan = *planned.PlanOf(world);
  const plan::StepId step = planned.assembly.knowledge.actions.at(error.step).step;
  return FaultMaker(planned.worlds[world], error, random)
      .Make(plan.step(step).action, Signalling(plan, step, error.error));
}

}  // namespace assay::execution
