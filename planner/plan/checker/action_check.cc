#include "planner/plan/checker/action_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "planner/domain/matings/mating_classes.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/separation.h"
#include "planner/plan/checker/pad_contact.h"
#include "planner/plan/checker/resting_balance.h"
#include "planner/plan/checker/straight_reach.h"

namespace assay::plan {
namespace {

using geometry::Vector3;

constexpr int kApproachIntervals = 10;
constexpr int kMatingIntervals = 20;
constexpr int kLeastTouch = 3;      // points at which both pads touch
constexpr double kRounding = 1e-6;  // metres and radians
constexpr double kDegree = M_PI / 180;

}  // namespace

// The work of an action. The part is at X_WorldPart when the pads close or open. In a mating, the
// hand moves the part along `motion` before the pads open. In all other actions there is no such
// motion.
struct Handling {
  PartId part;
  Hold hold;  // without meaning if the hand does nothing
  Pose X_WorldPart = Pose::Identity();
  Vector3 motion = Vector3::Zero();  // metres, world; zero: no motion

  Pose X_WorldTool() const { return X_WorldPart * hold.X_PartTool; }
};

struct Obstacle {
  std::string name;
  std::vector<geometry::ConvexHull> solids;  // world
};

namespace {

std::vector<geometry::RoundSolid> RoundSolidsAt(const Pose& X_WorldPart,
                                                const domain::PartModel& model) {
  std::vector<geometry::RoundSolid> solids = model.round_solids();
  for (geometry::RoundSolid& solid : solids) solid = Transformed(solid, X_WorldPart);
  return solids;
}

Handling HandlingOf(const domain::Problem& problem, const Action& action) {
  const Pose& X_WorldPlaced = action.place.X_WorldPart;
  if (action.kind->leaves != domain::Leaves::kMated) {
    return {action.part, action.hold, X_WorldPlaced};
  }
  const domain::Mating& mating = problem.mating(action.mating);
  return {mating.held, action.hold, X_WorldPlaced * mating.X_FixedHeld,
          X_WorldPlaced.linear() * mating.mating_vector};
}

// The solids of one moving thing at the samples of its motion.
struct Sweep {
  std::string mover;
  std::vector<std::vector<geometry::ConvexHull>> samples;  // world
};

Sweep SweepAlong(const std::string& mover, const std::vector<geometry::ConvexHull>& solids,
                 std::span<const Pose> poses) {
  Sweep sweep{mover, {}};
  for (const Pose& X_WorldMover : poses) {
    sweep.samples.push_back(geometry::Transformed(solids, X_WorldMover));
  }
  return sweep;
}

std::vector<geometry::ConvexHull> HandAt(const kinematics::Gripper& gripper, double opening) {
  std::vector<geometry::Box> boxes = gripper.HandBoxes();
  std::ranges::copy(gripper.FingerBoxes(opening), std::back_inserter(boxes));
  return geometry::HullsOf(boxes);
}

double DeepestOverlap(const Sweep& sweep, const Obstacle& obstacle) {
  double deepest = 0;
  for (const std::vector<geometry::ConvexHull>& sample : sweep.samples) {
    deepest = std::max(deepest, geometry::OverlapDepth(sample, obstacle.solids));
  }
  return deepest;
}

double LowestOf(const Sweep& sweep) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::vector<geometry::ConvexHull>& sample : sweep.samples) {
    lowest = std::min(lowest, geometry::LowestPoint(sample));
  }
  return lowest;
}

}  // namespace

class ActionChecker::Examination {
 public:
  Examination(const ActionChecker& checker, const WorldState& before, const Handling& handling)
      : problem_(checker.problem_),
        cell_(*checker.problem_.workcell),
        centers_(checker.centers_),
        handling_(handling),
        allowance_(cell_.rules().contact_allowance + kRounding) {
    CollectObstacles(before);
  }

  std::vector<std::string> Run(const Action& action) {
    if (HoldIn(action) != nullptr) {
      if (!OpensWideEnough()) return findings_;
      ExamineHand();
    }
    if (action.kind->leaves == domain::Leaves::kAtPlace) ExamineResting(action.place.X_WorldPart);
    if (action.kind->leaves == domain::Leaves::kMated) ExamineMating(action);
    return findings_;
  }

 private:
  const domain::Part& part() const { return problem_.part(handling_.part); }
  const kinematics::Gripper& gripper() const { return cell_.gripper(); }

  template <class... Args>
  void Report(fmt::format_string<Args...> text, Args&&... args) {
    findings_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void CollectObstacles(const WorldState& before) {
    for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
      const PartState& state = before.parts[i];
      if (PartId(i) == handling_.part || state.status == PartStatus::kHeld) continue;
      const domain::Part& other = problem_.parts[i];
      obstacles_.push_back(
          {other.name, geometry::Transformed(other.model->pieces(), state.X_WorldPart)});
    }
  }

  bool OpensWideEnough() {
    const double width = handling_.hold.width;
    if (width > 0 && width <= gripper().max_opening()) return true;
    Report("the hold is {:.4g} mm wide; the gripper opens from 0 to {:.4g} mm", width * 1e3,
           gripper().max_opening() * 1e3);
    return false;
  }

  void ExamineHand() {
    ExaminePads();
    ExamineHandAgainstPart();
    ExamineLean();
    ExamineHandAgainstWorld();
    ExamineReach();
  }

  // A two-sided grasp needs pads that touch the part opposite each other. The faces that they press
  // must not lie on the table (Spar, "Reachability of Grasps", first condition).
  void ExaminePads() {
    const auto pads = PadContactsOf(handling_.hold, gripper().pad_half_extents());
    if (PointsOfTouch(pads, part().model->pieces()) < kLeastTouch) {
      Report("the pads do not touch {} opposite each other", part().name);
    }
    for (const PadContact& pad : pads) {
      const Vector3 normal = handling_.X_WorldPart.linear() * pad.normal;
      const double height = (handling_.X_WorldPart * pad.points.front()).z();
      if (normal.z() < -1 + kRounding && height < allowance_) {
        Report("the {} pad presses a face of {} that lies on the table", pad.finger, part().name);
      }
    }
  }

  // Examines the hand in the part's own frame: closed at the grasp, and open on the straight way to
  // and from it.
  void ExamineHandAgainstPart() {
    const Obstacle held{part().name, part().model->pieces()};
    const Pose& X_PartTool = handling_.hold.X_PartTool;
    ReportOverlap(SweepAlong("the closed hand", HandAt(gripper(), handling_.hold.width),
                             std::array{X_PartTool}),
                  held);
    ReportOverlap(SweepAlong("the open hand", HandAt(gripper(), gripper().max_opening()),
                             Retreat(X_PartTool)),
                  held);
  }

  void ExamineLean() {
    const Vector3 approach = handling_.X_WorldTool().linear().col(2);
    const double lean = std::acos(std::clamp(-approach.z(), -1.0, 1.0));
    if (lean <= cell_.rules().tool_lean + kRounding) return;
    Report("the tool leans {:.4g} degrees from straight down; at most {:.4g} degrees",
           lean / kDegree, cell_.rules().tool_lean / kDegree);
  }

  void ExamineHandAgainstWorld() {
    const Pose X_WorldTool = handling_.X_WorldTool();
    ExamineSweep(SweepAlong("the open hand", HandAt(gripper(), gripper().max_opening()),
                            Retreat(X_WorldTool)));
    ExamineSweep(SweepAlong("the closed hand", HandAt(gripper(), handling_.hold.width),
                            MotionOf(X_WorldTool)));
  }

  void ExamineReach() {
    const Pose X_WorldTool = handling_.X_WorldTool();
    std::vector<ToolLine> lines = {Retreat(X_WorldTool)};
    if (!handling_.motion.isZero()) lines.push_back(MotionOf(X_WorldTool));
    if (const std::optional<std::string> why = WhyOutOfReach(cell_, lines)) Report("{}", *why);
  }

  void ExamineResting(const Pose& X_WorldPart) {
    const std::vector<geometry::ConvexHull> solids =
        geometry::Transformed(part().model->pieces(), X_WorldPart);
    const double lowest = geometry::LowestPoint(solids);
    if (!(std::abs(lowest) <= kRounding)) {
      Report("the lowest point of {} is {:.4g} mm above the table, not on it", part().name,
             lowest * 1e3);
    }
    ExamineBalance(geometry::VerticesOf(solids), X_WorldPart);
    const Sweep placed{part().name, {solids}};
    for (const Obstacle& obstacle : obstacles_) ReportOverlap(placed, obstacle);
  }

  void ExamineMating(const Action& action) {
    ExamineFrictionCone();
    ExamineMatingFeatures(problem_.mating(action.mating), action.place.X_WorldPart);
    ExamineSweep(SweepAlong(part().name, part().model->pieces(), MotionOf(handling_.X_WorldPart)));
  }

  void ExamineBalance(const std::vector<Vector3>& corners, const Pose& X_WorldPart) {
    const std::vector<Vector3> touching =
        TouchingTable(corners, RoundSolidsAt(X_WorldPart, *part().model));
    const Vector3 center = X_WorldPart * centers_[handling_.part.index()];
    if (!IsSupported(center, touching)) {
      Report(
          "{} does not rest stably: its centre of mass at {} is not over the {} points that "
          "touch the table",
          part().name, InMillimetres(center), touching.size());
    }
    const auto is_on = [&](const domain::Table& table) {
      return FirstOutside(corners, table.top) == nullptr;
    };
    if (std::ranges::none_of(cell_.tables(), is_on)) {
      Report("{} reaches beyond the table at {}", part().name,
             InMillimetres(*FirstOutside(corners, cell_.table().top)));
    }
  }

  // The mating motion must push the fixed part onto the table and not along it (Spar, "Stable Poses
  // and Position Classes"): within atan(friction) of straight down.
  void ExamineFrictionCone() {
    const double mu = domain::LeastMatingFriction(problem_);
    const Vector3& v = handling_.motion;
    if (-v.z() >= v.norm() / std::sqrt(1 + mu * mu) - kRounding) return;
    Report(
        "the mating vector is {:.4g} degrees from straight down, outside the friction cone of "
        "{:.4g} degrees",
        std::acos(std::clamp(-v.z() / v.norm(), -1.0, 1.0)) / kDegree, std::atan(mu) / kDegree);
  }

  // If the table is what stops the mating motion, the motion must go straight down to it.
  void ExamineTableEnd(const domain::Mating& mating, const Pose& X_WorldFixed) {
    if (!mating.ends_on_table) return;
    constexpr double kLevel = 1e-4;     // metres from the table
    constexpr double kStraight = 1e-6;  // 1 less the cosine of the angle from straight down
    const double lowest = geometry::LowestPoint(
        geometry::Transformed(part().model->pieces(), X_WorldFixed * mating.X_FixedHeld));
    const Vector3& v = handling_.motion;
    if (std::abs(lowest) <= kLevel && -v.z() >= (1 - kStraight) * v.norm()) return;
    Report("the mating of {} ends on the table, but not straight down at its height", part().name);
  }

  // Returns whether a hole goes through its part and opens upward, where shafts enter it. The table
  // may then cover its other mouth.
  static bool OpensAbove(const domain::Feature& hole, const Pose& X_WorldPart) {
    return hole.mouths.size() > 1 &&
           (X_WorldPart.linear() * hole.X_PartFeature.linear()).col(2).z() > 0.5;
  }

  void ExamineMatingFeatures(const domain::Mating& mating, const Pose& X_WorldFixed) {
    ExamineTableEnd(mating, X_WorldFixed);
    const domain::Part& fixed = problem_.part(mating.fixed);
    for (const auto& [of_held, of_fixed] : mating.features) {
      const domain::Feature* hole = fixed.model->FindFeature(of_fixed);
      if (hole != nullptr && !OpensAbove(*hole, X_WorldFixed) &&
          IsOnTable(*fixed.model, *hole, X_WorldFixed)) {
        Report("mating feature {} of {} is on the table", of_fixed.index(), fixed.name);
      }
      const domain::Feature* shaft = part().model->FindFeature(of_held);
      if (shaft != nullptr && !IsTouchedOutside(mating, hole, *shaft)) ExaminePadsAgainst(*shaft);
    }
  }

  // Returns whether both pads are outside of the face in which the shaft's hole opens, once the
  // shaft is seated.
  bool IsTouchedOutside(const domain::Mating& mating, const domain::Feature* hole,
                        const domain::Feature& shaft) const {
    if (hole == nullptr || !shaft.mouths.empty()) return false;
    const auto pads = PadContactsOf(handling_.hold, gripper().pad_half_extents());
    return std::ranges::any_of(hole->mouths, [&](const domain::Mouth& mouth) {
      const domain::Face& face = problem_.part(mating.fixed).model->faces()[mouth.face.index()];
      if (face.normal.dot(mating.mating_vector) > 0) return false;
      return std::ranges::all_of(pads, [&](const PadContact& pad) {
        return std::ranges::all_of(pad.points, [&](const Vector3& p) {
          return face.normal.dot(mating.X_FixedHeld * p) > face.offset;
        });
      });
    });
  }

  void ExaminePadsAgainst(const domain::Feature& feature) {
    for (const PadContact& pad : PadContactsOf(handling_.hold, gripper().pad_half_extents())) {
      if (!Covers(pad, *part().model, feature)) continue;
      Report("the {} pad covers mating feature {} of {}", pad.finger, feature.number.index(),
             part().name);
    }
  }

  // Returns the line from a pose of the tool, in any frame, back along the tool's approach vector.
  ToolLine Retreat(const Pose& X_FrameTool) const {
    return LineFrom(X_FrameTool, -cell_.rules().approach_distance * X_FrameTool.linear().col(2),
                    kApproachIntervals);
  }

  // Returns the line from a pose back to where the part's last motion starts. Returns the pose
  // alone if there is no such motion.
  ToolLine MotionOf(const Pose& X_WorldMover) const {
    if (handling_.motion.isZero()) return {X_WorldMover};
    return LineFrom(X_WorldMover, -handling_.motion, kMatingIntervals);
  }

  void ExamineSweep(const Sweep& sweep) {
    const double lowest = LowestOf(sweep);
    if (!(lowest >= -allowance_)) {
      Report("{} reaches {:.4g} mm below the table's top", sweep.mover, -lowest * 1e3);
    }
    for (const Obstacle& obstacle : obstacles_) ReportOverlap(sweep, obstacle);
  }

  void ReportOverlap(const Sweep& sweep, const Obstacle& obstacle) {
    const double depth = DeepestOverlap(sweep, obstacle);
    if (depth <= allowance_) return;
    Report("{} overlaps {} by {:.4g} mm; at most {:.4g} mm", sweep.mover, obstacle.name,
           depth * 1e3, cell_.rules().contact_allowance * 1e3);
  }

  const domain::Problem& problem_;
  const domain::Workcell& cell_;
  const std::vector<Vector3>& centers_;
  Handling handling_;
  double allowance_;  // overlap that is ignored, metres
  std::vector<Obstacle> obstacles_;
  std::vector<std::string> findings_;
};

ActionChecker::ActionChecker(const domain::Problem& problem) : problem_(problem) {
  for (const domain::Part& part : problem.parts) {
    centers_.push_back(CenterOfMass(part.model->pieces()));
  }
}

std::vector<std::string> ActionChecker::BrokenConditions(const WorldState& before,
                                                         const Action& action) const {
  return Examination(*this, before, HandlingOf(problem_, action)).Run(action);
}

}  // namespace assay::plan
