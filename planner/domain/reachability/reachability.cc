#include "planner/domain/reachability/reachability.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/base/check.h"
#include "planner/domain/reachability/action_ways.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

using geometry::CollisionShape;
using geometry::Matrix3;

// Faces lie on the table if they differ from it by less: radians of direction, and metres of
// height.
constexpr double kParallel = std::numbers::pi / 180;
constexpr double kOnTable = 1e-3;
constexpr double kClearanceStep = 0.01;  // metres between the tested positions of a hand on its way

// The question that a caller asks about a set of conditions.
enum class Ask {
  kWhetherAll,          // whether all hold; the search stops at the first broken one
  kWhetherAllButClear,  // whether all but kMateClear hold
  kWhichBroken,
};

// Collects the broken conditions. Conditions that cost little are required first.
class Findings {
 public:
  explicit Findings(Ask ask) : ask_(ask) {}

  template <class Holds>
  void Require(GraspCondition condition, const Holds& holds) {
    if (ask_ != Ask::kWhichBroken && broken_ != 0) return;
    if (ask_ == Ask::kWhetherAllButClear && condition == GraspCondition::kMateClear) return;
    if (!holds()) broken_ |= static_cast<GraspConditions>(condition);
  }
  GraspConditions broken() const { return broken_; }

 private:
  Ask ask_;
  GraspConditions broken_ = 0;
};

// The place of a part at rest: X_WorldPart itself, or X_WorldPart moved on the table by any of the
// placements.
struct Location {
  PartId part;
  Pose X_WorldPart;
  std::span<const Placement> placements = {};
};

Location InPose(const Problem& problem, PartId part, StablePoseId pose) {
  return {.part = part,
          .X_WorldPart = problem.part(part).model->stable_poses()[pose.index()].X_TablePart,
          .placements = problem.workcell->placements()};
}

// Returns whether `reaches` holds for a pose of the part on the table that the location allows.
template <class Reaches>
bool AtSomePlacement(const Problem& problem, const Location& location, const Reaches& reaches) {
  if (location.placements.empty()) return reaches(location.X_WorldPart);
  return std::ranges::any_of(location.placements, [&](const Placement& placement) {
    const Pose X_WorldPart = placement.X_WorldTable() * location.X_WorldPart;
    return reaches(X_WorldPart) && OnTable(problem, location.part, X_WorldPart);
  });
}

const Grasp& GraspOf(const Problem& problem, PartId part, GraspId grasp) {
  return (*problem.part(part).grasps)[grasp.index()];
}

bool OpensFor(const Workcell& workcell, const Grasp& grasp) {
  return grasp.width <= workcell.gripper().max_opening() + kRounding;
}

// Returns the opening of fingers closed on the part. For a grasp that is too wide, it is the
// greatest opening.
double ClosedOpening(const Workcell& workcell, const Grasp& grasp) {
  return std::min(grasp.width, workcell.gripper().max_opening());
}

// Returns whether a pad presses a face that lies on the table. The sides of a part that stands on
// its tip are free, though tip and sides belong to one feature.
bool PressesTable(const Grasp& grasp, const Pose& X_WorldTool) {
  const double vertical = std::abs(X_WorldTool.linear().col(1).z());
  const double lowest = X_WorldTool.translation().z() - vertical * grasp.width / 2;
  return vertical >= std::cos(kParallel) && lowest <= kOnTable;
}

bool LeansLittle(const Workcell& workcell, const Pose& X_WorldTool) {
  return LeanOf(X_WorldTool.linear().col(2)) <= workcell.rules().tool_lean + kRounding;
}

double LowestPoint(const geometry::Box& box, const Pose& X_WorldTool) {
  const Pose X_WorldBox = X_WorldTool * box.X_FrameBox;
  return X_WorldBox.translation().z() -
         X_WorldBox.linear().row(2).cwiseAbs().dot(box.half_extents.transpose());
}

double LowestPoint(std::span<const geometry::Box> boxes, const Pose& X_WorldTool) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const geometry::Box& box : boxes) lowest = std::min(lowest, LowestPoint(box, X_WorldTool));
  return lowest;
}

// Returns the height of hand and fingers, open and closed, above the table. A tool with an allowed
// lean goes up as it retreats, so the end of its way is its lowest point.
double HandHeight(const Workcell& workcell, const Grasp& grasp, const Pose& X_WorldTool) {
  const kinematics::Gripper& gripper = workcell.gripper();
  return std::min({LowestPoint(gripper.HandBoxes(), X_WorldTool),
                   LowestPoint(gripper.FingerBoxes(gripper.max_opening()), X_WorldTool),
                   LowestPoint(gripper.FingerBoxes(ClosedOpening(workcell, grasp)), X_WorldTool)});
}

bool ClearsTable(const Workcell& workcell, const Grasp& grasp, const Pose& X_WorldTool) {
  return HandHeight(workcell, grasp, X_WorldTool) >=
         -workcell.rules().contact_allowance - kRounding;
}

Pose Moved(const Pose& X, const Vector3& by) { return geometry::Translation(by) * X; }

// A hand, with its fingers open or closed, that goes past the fixed part. Everything is in the
// fixed part's frame.
class HandBesideFixed {
 public:
  HandBesideFixed(const Problem& problem, const Mating& mating, double opening)
      : hand_(problem.workcell->HandShape(opening)),
        fixed_(problem.part(mating.fixed).model->shape()),
        allowance_(problem.workcell->rules().contact_allowance) {}

  bool IsFreeAt(const Pose& X_FixedTool) const {
    return !Overlaps(hand_, X_FixedTool, fixed_, Pose::Identity(), allowance_);
  }
  bool IsFreeAlong(const Pose& X_FixedTool, const Vector3& line) const {
    const int steps = std::max(1, static_cast<int>(std::ceil(line.norm() / kClearanceStep)));
    for (int i = 0; i <= steps; ++i) {
      if (!IsFreeAt(Moved(X_FixedTool, static_cast<double>(i) / steps * line))) return false;
    }
    return true;
  }

 private:
  CollisionShape hand_;
  const CollisionShape& fixed_;
  double allowance_;
};

// The closed hand comes along the mating vector, and the open hand retreats. Open fingers are
// tested at the start of the mating, too, so that the part can be let go there.
bool ClearsFixed(const Problem& problem, const Mating& mating, const Grasp& grasp) {
  const Workcell& workcell = *problem.workcell;
  const Pose X_FixedTool = mating.X_FixedHeld * grasp.X_PartTool;
  const HandBesideFixed closed(problem, mating, ClosedOpening(workcell, grasp));
  const HandBesideFixed open(problem, mating, workcell.gripper().max_opening());
  return open.IsFreeAlong(X_FixedTool, Retreat(workcell, X_FixedTool)) &&
         closed.IsFreeAlong(X_FixedTool, -mating.mating_vector) &&
         open.IsFreeAt(Moved(X_FixedTool, -mating.mating_vector));
}

GraspConditions Broken(const Problem& problem, GraspId id, const Location& location, Ask ask) {
  const Workcell& workcell = *problem.workcell;
  const Grasp& grasp = GraspOf(problem, location.part, id);
  const Pose X_WorldTool = location.X_WorldPart * grasp.X_PartTool;
  Findings findings(ask);
  findings.Require(GraspCondition::kOpening, [&] { return OpensFor(workcell, grasp); });
  findings.Require(GraspCondition::kPadsFit, [&] { return grasp.room.fits(); });
  findings.Require(GraspCondition::kFacesFree, [&] { return !PressesTable(grasp, X_WorldTool); });
  findings.Require(GraspCondition::kToolLean, [&] { return LeansLittle(workcell, X_WorldTool); });
  findings.Require(GraspCondition::kTableClear,
                   [&] { return ClearsTable(workcell, grasp, X_WorldTool); });
  findings.Require(GraspCondition::kReach, [&] {
    return AtSomePlacement(problem, location, [&](const Pose& X_WorldPart) {
      return ReachesGrasp(workcell, X_WorldPart * grasp.X_PartTool);
    });
  });
  return findings.broken();
}

GraspConditions BrokenMating(const Problem& problem, const Mating& mating, GraspId id,
                             const Location& location, Ask ask) {
  const Workcell& workcell = *problem.workcell;
  const Grasp& grasp = GraspOf(problem, mating.held, id);
  const Pose X_FixedTool = mating.X_FixedHeld * grasp.X_PartTool;
  const Pose X_WorldTool = location.X_WorldPart * X_FixedTool;
  const Vector3 vector_World = location.X_WorldPart.linear() * mating.mating_vector;
  Findings findings(ask);
  findings.Require(GraspCondition::kOpening, [&] { return OpensFor(workcell, grasp); });
  findings.Require(GraspCondition::kPadsFit, [&] { return grasp.room.fits(); });
  findings.Require(GraspCondition::kToolLean, [&] { return LeansLittle(workcell, X_WorldTool); });
  findings.Require(GraspCondition::kTableClear, [&] {
    return ClearsTable(workcell, grasp, X_WorldTool) &&
           ClearsTable(workcell, grasp, Moved(X_WorldTool, -vector_World));
  });
  findings.Require(GraspCondition::kMateClear, [&] { return ClearsFixed(problem, mating, grasp); });
  findings.Require(GraspCondition::kReach, [&] {
    return AtSomePlacement(problem, location, [&](const Pose& X_WorldFixed) {
      return ReachesMating(workcell, X_WorldFixed * X_FixedTool,
                           X_WorldFixed.linear() * mating.mating_vector);
    });
  });
  return findings.broken();
}

GraspConditions FindAt(const Problem& problem, PartId part, GraspId grasp, const Pose& X_WorldPart,
                       Ask ask) {
  return Broken(problem, grasp, {.part = part, .X_WorldPart = X_WorldPart}, ask);
}

GraspConditions FindIn(const Problem& problem, PartId part, GraspId grasp, StablePoseId pose,
                       Ask ask) {
  return Broken(problem, grasp, InPose(problem, part, pose), ask);
}

GraspConditions FindMatingAt(const Problem& problem, MatingId id, GraspId grasp,
                             const Pose& X_WorldFixed, Ask ask) {
  const Mating& mating = problem.mating(id);
  return BrokenMating(problem, mating, grasp, {.part = mating.fixed, .X_WorldPart = X_WorldFixed},
                      ask);
}

GraspConditions FindMatingIn(const Problem& problem, MatingId id, GraspId grasp,
                             StablePoseId pose_of_fixed, Ask ask) {
  const Mating& mating = problem.mating(id);
  return BrokenMating(problem, mating, grasp, InPose(problem, mating.fixed, pose_of_fixed), ask);
}

// Returns the first of `others`, except `itself`, that the shape goes through.
PartId FirstHit(const Problem& problem, const CollisionShape& shape, const Pose& X_WorldShape,
                PartId itself, std::span<const PlacedPart> others) {
  const double allowance = problem.workcell->rules().contact_allowance;
  const auto hit = std::ranges::find_if(others, [&](const PlacedPart& other) {
    return other.part != itself &&
           Overlaps(shape, X_WorldShape, problem.part(other.part).model->shape(), other.X_WorldPart,
                    allowance);
  });
  return hit == others.end() ? PartId::None() : hit->part;
}

double Degrees(double radians) { return radians * 180 / std::numbers::pi; }
double Millimetres(double metres) { return 1000 * metres; }

}  // namespace

GraspConditions BrokenAt(const Problem& problem, PartId part, GraspId grasp,
                         const Pose& X_WorldPart) {
  return FindAt(problem, part, grasp, X_WorldPart, Ask::kWhichBroken);
}

GraspConditions BrokenIn(const Problem& problem, PartId part, GraspId grasp, StablePoseId pose) {
  return FindIn(problem, part, grasp, pose, Ask::kWhichBroken);
}

GraspConditions BrokenMatingAt(const Problem& problem, MatingId mating, GraspId grasp,
                               const Pose& X_WorldFixed) {
  return FindMatingAt(problem, mating, grasp, X_WorldFixed, Ask::kWhichBroken);
}

GraspConditions BrokenMatingIn(const Problem& problem, MatingId mating, GraspId grasp,
                               StablePoseId pose_of_fixed) {
  return FindMatingIn(problem, mating, grasp, pose_of_fixed, Ask::kWhichBroken);
}

bool IsReachableAt(const Problem& problem, PartId part, GraspId grasp, const Pose& X_WorldPart) {
  return FindAt(problem, part, grasp, X_WorldPart, Ask::kWhetherAll) == 0;
}

bool IsReachableIn(const Problem& problem, PartId part, GraspId grasp, StablePoseId pose) {
  return FindIn(problem, part, grasp, pose, Ask::kWhetherAll) == 0;
}

bool IsMateReachableAt(const Problem& problem, MatingId mating, GraspId grasp,
                       const Pose& X_WorldFixed) {
  return FindMatingAt(problem, mating, grasp, X_WorldFixed, Ask::kWhetherAll) == 0;
}

bool IsMateReachableIn(const Problem& problem, MatingId mating, GraspId grasp,
                       StablePoseId pose_of_fixed) {
  return FindMatingIn(problem, mating, grasp, pose_of_fixed, Ask::kWhetherAll) == 0;
}

bool HandClearsFixed(const Problem& problem, MatingId id, GraspId grasp) {
  const Mating& mating = problem.mating(id);
  return ClearsFixed(problem, mating, GraspOf(problem, mating.held, grasp));
}

bool IsMatingPlaceReachableAt(const Problem& problem, MatingId mating, GraspId grasp,
                              const Pose& X_WorldFixed) {
  return FindMatingAt(problem, mating, grasp, X_WorldFixed, Ask::kWhetherAllButClear) == 0;
}

bool IsMatingPlaceReachableIn(const Problem& problem, MatingId mating, GraspId grasp,
                              StablePoseId pose_of_fixed) {
  return FindMatingIn(problem, mating, grasp, pose_of_fixed, Ask::kWhetherAllButClear) == 0;
}

PartId Obstacle(const Problem& problem, const Pose& X_WorldTool, double opening,
                std::span<const PlacedPart> others) {
  return FirstHit(problem, problem.workcell->HandShape(opening), X_WorldTool, PartId::None(),
                  others);
}

PartId Obstacle(const Problem& problem, const PlacedPart& moving,
                std::span<const PlacedPart> others) {
  return FirstHit(problem, problem.part(moving.part).model->shape(), moving.X_WorldPart,
                  moving.part, others);
}

double LeanOf(const Vector3& direction) {
  return std::atan2(direction.head<2>().norm(), -direction.z());
}

std::optional<Limited> Measure(const Problem& problem, GraspCondition condition, const Grasp& grasp,
                               const Pose& X_WorldTool) {
  const Workcell& workcell = *problem.workcell;
  switch (condition) {
    case GraspCondition::kOpening:
      return Limited{grasp.width, workcell.gripper().max_opening()};
    case GraspCondition::kPadsFit:
      return Limited{grasp.room.needed, grasp.room.available};
    case GraspCondition::kToolLean:
      return Limited{LeanOf(X_WorldTool.linear().col(2)), workcell.rules().tool_lean};
    case GraspCondition::kTableClear:
      return Limited{-HandHeight(workcell, grasp, X_WorldTool), workcell.rules().contact_allowance};
    case GraspCondition::kFacesFree:
    case GraspCondition::kReach:
    case GraspCondition::kMateClear:
      break;
  }
  return std::nullopt;
}

std::string Describe(const Problem& problem, GraspCondition condition) {
  const Workcell& workcell = *problem.workcell;
  switch (condition) {
    case GraspCondition::kOpening:
      return fmt::format("the gripper opens at most {:.4g} mm",
                         Millimetres(workcell.gripper().max_opening()));
    case GraspCondition::kPadsFit:
      return "the pads have room on the faces that they hold";
    case GraspCondition::kFacesFree:
      return "the held faces are not on the table";
    case GraspCondition::kToolLean:
      return fmt::format("the tool leans at most {:.4g} deg from straight down",
                         Degrees(workcell.rules().tool_lean));
    case GraspCondition::kTableClear:
      return "hand and fingers do not go through the table";
    case GraspCondition::kReach:
      return fmt::format(
          "the arm gets there from {:.4g} mm above the table within its joint limits{}",
          Millimetres(workcell.rules().safe_height),
          workcell.rules().keeps_configuration ? " and in one configuration" : "");
    case GraspCondition::kMateClear:
      return "hand and fingers do not go through the part that is mated with";
  }
  ASSAY_CHECK(false, "a condition that the switch does not know");
  return {};
}

}  // namespace assay::domain
