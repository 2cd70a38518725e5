#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <variant>

#include "planner/domain/part/resting.h"
#include "planner/motion/path/joint_trajectory.h"
#include "planner/motion/path/path_search.h"
#include "planner/motion/path/straight_line.h"
#include "sim/enact/skills/skill.h"
#include "sim/exec/commands/action_commands.h"
#include "sim/exec/execution/travel.h"

namespace assay::enact {
namespace {

using exec::Pose;
using geometry::Vector2;
using geometry::Vector3;
using kinematics::JointVector;

constexpr double kPlacePitch = 0.05;      // metres between tried places
constexpr double kPlaceRoom = 0.06;       // metres between parts, room for fingers that open
constexpr double kClearance = 0.015;      // metres, because believed poses have errors
constexpr double kLookPitch = 0.02;       // metres of tool travel between checks on straight lines
constexpr int kMostSearches = 20;         // path searches that use up their budget in vain
constexpr std::int64_t kBudget = 20'000;  // postures that one search examines
constexpr domain::Range kUprightTilts = {std::numbers::pi / 1800, std::numbers::pi / 2};

// Returns places on the table, those nearest to its middle first.
std::vector<Vector2> PlacesOn(const domain::Table& table) {
  Eigen::AlignedBox2d box;
  for (const Vector2& corner : table.top) box.extend(corner);
  const Eigen::Vector2i steps = (box.sizes() / 2 / kPlacePitch).cast<int>();
  std::vector<Vector2> places;
  for (int i = -steps.x(); i <= steps.x(); ++i) {
    for (int k = -steps.y(); k <= steps.y(); ++k) {
      places.emplace_back(box.center() + kPlacePitch * Vector2(i, k));
    }
  }
  const auto squared = [&](const Vector2& p) {
    return std::round((p - box.center()).squaredNorm() / (kPlacePitch * kPlacePitch));
  };
  std::ranges::stable_sort(places, {}, squared);
  return places;
}

// Searches for a free place on the table to which the held part can be carried, and for the arm's
// path to a posture above it.
class WaySearch {
 public:
  WaySearch(const domain::Table& table, std::optional<double> tilt, const Situation& situation)
      : table_(table),
        situation_(situation),
        execution_(situation.execution()),
        workcell_(*situation.problem().workcell),
        world_(execution_.world()),
        scene_(situation.problem(), execution_.BelievedSurroundings()),
        rules_(RulesFor(tilt)),
        arm_on_lines_(scene_, {.clearance = motion::kTravelGap, .bodies = Bodies::kArm}),
        robots_on_lines_(scene_, {.clearance = motion::kTravelGap, .bodies = Bodies::kRobots}) {}

  // Returns the path, or why there is none. If several attempts failed, it returns the reason of
  // the first attempt.
  std::variant<motion::JointPath, std::string> Find() {
    const JointVector& from = execution_.commanded();
    if (const auto now = motion::MotionCheck(scene_, rules_).FindObstruction(from, from)) {
      return "at the start, " + Describe(scene_, rules_, *now);
    }
    const std::vector<Pose> places = FreePlaces();
    for (const Pose& X_WorldPart : places) {
      const std::vector<Vector3> corners = CornersOfPuttingDown(X_WorldPart);
      for (const JointVector& q : PosturesAbove(X_WorldPart, corners)) {
        if (searches_in_vain_ == kMostSearches) return why_;
        if (!IsFreeBelow(q, corners)) continue;
        if (auto path = WayTo(q)) return *std::move(path);
      }
    }
    if (!why_.empty()) return why_;
    return places.empty() ? "none is free" : "the arm cannot put it down on any";
  }

 private:
  using Bodies = motion::MotionRules::Bodies;

  // The tool's direction that points up at the start must stay within `tilt` of it on the whole
  // way.
  motion::MotionRules RulesFor(std::optional<double> tilt) const {
    motion::MotionRules rules{.clearance = kClearance};
    if (!tilt) return rules;
    const Pose X_WorldTool = X_WorldHeld() * world_.hold().X_PartTool;
    rules.upright = {.up_Tool = X_WorldTool.linear().transpose() * Vector3::UnitZ(), .tilt = *tilt};
    return rules;
  }

  Pose X_WorldHeld() const { return world_.PartPose(world_.held(), execution_.BelievedTool()); }

  // Returns free poses of the part on the table, world frame. The part leans as it does in the hand
  // and may be turned about the vertical.
  std::vector<Pose> FreePlaces() const {
    const domain::Part& part = situation_.problem().part(world_.held());
    const std::vector<domain::PlacedPart> standing = situation_.Standing(world_.held());
    double lowest = 1e9;
    for (const Vector3& vertex : part.model->hull().vertices) {
      lowest = std::min(lowest, (X_WorldHeld().linear() * vertex).z());
    }
    std::vector<Pose> free;
    for (const Vector2& place : PlacesOn(table_)) {
      for (int i = 0; i < kYawsTried; ++i) {
        Pose X_WorldPart =
            geometry::RotationZ(2 * std::numbers::pi * i / kYawsTried) * X_WorldHeld();
        X_WorldPart.translation() = Vector3(place.x(), place.y(), -lowest);
        if (IsFree(part, X_WorldPart, standing)) free.push_back(X_WorldPart);
      }
    }
    return free;
  }

  bool IsFree(const domain::Part& part, const Pose& X_WorldPart,
              const std::vector<domain::PlacedPart>& standing) const {
    if (!domain::IsOver(table_, part, X_WorldPart)) return false;
    const geometry::Polygon footprint = domain::Footprint(part, X_WorldPart);
    return std::ranges::all_of(standing, [&](const domain::PlacedPart& other) {
      const domain::Part& neighbour = situation_.problem().part(other.part);
      return geometry::Gap(footprint, domain::Footprint(neighbour, other.X_WorldPart)) > kPlaceRoom;
    });
  }

  // Returns the corners of the straight lines that putting the part down takes: down with the part,
  // then up without it.
  std::vector<Vector3> CornersOfPuttingDown(const Pose& X_WorldPart) const {
    const plan::Action putdown{.kind = &domain::kPutdown,
                               .part = world_.held(),
                               .hold = world_.hold(),
                               .place = {"free", X_WorldPart}};
    const std::vector<exec::Command> commands =
        exec::CommandsFor(situation_.problem(), world_, putdown).InOrder();
    return exec::RequestFor(std::get<exec::MoveAtSafeHeight>(commands.front()),
                            std::span(commands).subspan(1), execution_)
        .corners;
  }

  // Returns the postures with the tool at safe height above the place from which the arm can follow
  // the straight lines. Postures in the arm's present configuration come first, then nearer ones
  // before farther ones.
  std::vector<JointVector> PosturesAbove(const Pose& X_WorldPart,
                                         const std::vector<Vector3>& corners) const {
    const JointVector& from = execution_.commanded();
    const Pose X_WorldTool = execution_.Erring(X_WorldPart * world_.hold().X_PartTool);
    std::vector<JointVector> postures =
        motion::PosturesAt(workcell_, exec::AtSafeHeight(workcell_, X_WorldTool), from);
    std::erase_if(postures, [&](const JointVector& q) {
      return !motion::FollowLines(workcell_, q, corners, motion::kLineStep);
    });
    const auto indicators = workcell_.arm().IndicatorsOf(from);
    std::ranges::stable_sort(postures, {}, [&](const JointVector& q) {
      return std::pair(workcell_.arm().IndicatorsOf(q) != indicators,
                       (q - from).cwiseAbs().maxCoeff());
    });
    return postures;
  }

  // Returns whether the straight lines below posture `q` are free. The checks are those of
  // motion::PlanTravel, so putting the part down needs no other posture.
  bool IsFreeBelow(const JointVector& q, const std::vector<Vector3>& corners) {
    const auto lines = motion::FollowLines(workcell_, q, corners, kLookPitch);
    if (!lines) return false;
    for (motion::MotionCheck* check : {&arm_on_lines_, &robots_on_lines_}) {
      for (std::size_t i = 0; i + 1 < lines->size(); ++i) {
        const auto obstruction = check->FindObstruction((*lines)[i], (*lines)[i + 1]);
        if (!obstruction) continue;
        Note("on the way down, " + Describe(scene_, check->rules(), *obstruction));
        return false;
      }
    }
    return true;
  }

  std::optional<motion::JointPath> WayTo(const JointVector& q) {
    motion::PathResult way = motion::FindPath(
        scene_, {.from = execution_.commanded(), .to = q, .rules = rules_, .budget = kBudget});
    if (auto* path = std::get_if<motion::JointPath>(&way)) return std::move(*path);
    const auto& failure = std::get<motion::PathFailure>(way);
    if (failure.reason == motion::PathFailure::Reason::kBudget) ++searches_in_vain_;
    Note(failure.what);
    return std::nullopt;
  }

  void Note(std::string why) {
    if (why_.empty()) why_ = std::move(why);
  }

  const domain::Table& table_;
  const Situation& situation_;
  const exec::Execution& execution_;
  const domain::Workcell& workcell_;
  const exec::WorldModel& world_;
  const motion::CollisionScene scene_;
  const motion::MotionRules rules_;
  motion::MotionCheck arm_on_lines_;  // without the held part, which must come near the table
  motion::MotionCheck robots_on_lines_;
  int searches_in_vain_ = 0;
  std::string why_;  // why the first place and posture failed
};

class Carry : public Skill {
 public:
  Carry(const domain::Table* to, std::optional<double> tilt) : to_(to), tilt_(tilt) {}

  std::string Lacks(const Roles& roles) const override {
    if (roles.part.IsNone()) return "part";
    return to_ == nullptr && roles.table == nullptr ? "table" : "";
  }

  exec::Progress Do(const Roles& roles, Situation& situation) const override {
    exec::Execution& execution = situation.execution();
    const std::string& name = situation.problem().part(roles.part).name;
    if (execution.world().held() != roles.part) {
      return exec::Failure{exec::ExecutionOutcome::kUnreachable, name + " is not in the hand"};
    }
    const domain::Table& table = to_ != nullptr ? *to_ : *roles.table;
    const auto way = WaySearch(table, tilt_, situation).Find();
    if (const auto* why = std::get_if<std::string>(&way)) {
      return exec::Failure{
          exec::ExecutionOutcome::kUnreachable,
          fmt::format("no way to a free place on {} for {}: {}", table.name, name, *why)};
    }
    const motion::JointRates rates = motion::RatesOf(*execution.problem().workcell);
    return execution.Follow(motion::AlongPath(std::get<motion::JointPath>(way), rates), 0);
  }

 private:
  const domain::Table* to_;     // null: the table of the action's arguments
  std::optional<double> tilt_;  // the greatest tilt on the way, radians; none: any tilt
};

}  // namespace

const SkillWord kCarry = {
    .name = "carry",
    .summary =
        "goes with the held part over a free place of the table `to`, or of the arguments, where "
        "it can be put down; never tilted by more than `upright`",
    .read = [](const Value& map, const SkillContext& context) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill", "to", "upright"});
      const auto to = map.Find("to");
      const auto upright = map.Find("upright");
      std::optional<double> tilt;
      if (upright) tilt = domain::ReadWithin(*upright, context.units.angle, kUprightTilts);
      return std::make_unique<Carry>(to ? &ReadTable(*to, context.problem) : nullptr, tilt);
    },
};

}  // namespace assay::enact
