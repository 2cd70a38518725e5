#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/domain/resting.h"
#include "planner/motion/joint_trajectory.h"
#include "planner/motion/path_search.h"
#include "sim/enact/skill.h"
#include "sim/exec/action_commands.h"
#include "sim/exec/straight_line.h"

namespace assay::enact {
namespace {

using exec::JointVector;
using exec::Pose;
using geometry::Vector2;
using geometry::Vector3;

constexpr double kPitch = 0.05;       // metres between places that are tried
constexpr int kYaws = 8;              // turns that are tried at each place
constexpr double kHandRoom = 0.06;    // metres between parts, for fingers that let go
constexpr double kClearance = 0.015;  // metres: parts are where they are believed up to some errors
constexpr domain::Range kTilts = {std::numbers::pi / 1800, std::numbers::pi / 2};

// Places on a table, nearest to its middle first.
std::vector<Vector2> PlacesOn(const domain::Table& table) {
  Eigen::AlignedBox2d box;
  for (const Vector2& corner : table.top) box.extend(corner);
  const Eigen::Vector2i steps = (box.sizes() / 2 / kPitch).cast<int>();
  std::vector<Vector2> places;
  for (int i = -steps.x(); i <= steps.x(); ++i) {
    for (int k = -steps.y(); k <= steps.y(); ++k) {
      places.emplace_back(box.center() + kPitch * Vector2(i, k));
    }
  }
  const auto squared = [&](const Vector2& p) {
    return std::round((p - box.center()).squaredNorm() / (kPitch * kPitch));
  };
  std::ranges::stable_sort(places, {}, squared);
  return places;
}

// The joint values of the tool at safe height over a place from which the part can be put down
// straight, and the hand go up again; those in the configuration of `from` first, and nearest.
std::vector<JointVector> PosturesAbove(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                       const JointVector& from) {
  std::vector<JointVector> postures;
  const Pose above = exec::AtSafeHeight(workcell, X_WorldTool);
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(above), from)) {
    for (const JointVector& q : workcell.arm().Representatives(s.q)) {
      if (exec::FollowLine(workcell, q, X_WorldTool.translation()).path) postures.push_back(q);
    }
  }
  const auto indicators = workcell.arm().IndicatorsOf(from);
  std::ranges::stable_sort(postures, {}, [&](const JointVector& q) {
    return std::pair(workcell.arm().IndicatorsOf(q) != indicators,
                     (q - from).cwiseAbs().maxCoeff());
  });
  return postures;
}

class Carry : public Skill {
 public:
  Carry(const domain::Table* to, std::optional<double> tilt) : to_(to), tilt_(tilt) {}

  std::string Lacks(const Roles& roles) const override {
    if (roles.part.IsNone()) return "part";
    return to_ == nullptr && roles.table == nullptr ? "table" : "";
  }

  exec::Progress Do(const Roles& roles, Situation& situation) const override {
    const exec::WorldModel& world = situation.execution().world();
    const std::string& name = situation.problem().part(roles.part).name;
    if (world.held() != roles.part) {
      return exec::Failure{exec::ExecutionOutcome::kUnreachable, name + " is not in the hand"};
    }
    const domain::Table& table = to_ != nullptr ? *to_ : *roles.table;
    const std::optional<motion::JointPath> path = FindWay(table, situation);
    if (!path) {
      return exec::Failure{exec::ExecutionOutcome::kUnreachable,
                           fmt::format("no way to a free place on {} for {}", table.name, name)};
    }
    return Follow(*path, situation.execution());
  }

 private:
  std::optional<motion::JointPath> FindWay(const domain::Table& table, Situation& situation) const {
    const domain::Problem& problem = situation.problem();
    exec::Execution& execution = situation.execution();
    const PartId part = execution.world().held();
    const plan::Hold& hold = execution.world().hold();
    const Pose X_WorldHeld = execution.world().PartPose(part, execution.BelievedTool());
    const std::vector<domain::PlacedPart> standing = situation.Standing(part);
    const motion::CollisionScene scene(problem, execution.BelievedSurroundings());
    const motion::MotionRules rules = RulesFor(X_WorldHeld, hold);
    for (const Pose& X_WorldPart : FreePlaces(table, problem, part, X_WorldHeld, standing)) {
      const Pose X_WorldTool = execution.Erring(X_WorldPart * hold.X_PartTool);
      for (const JointVector& q :
           PosturesAbove(*problem.workcell, X_WorldTool, execution.commanded())) {
        motion::PathResult way = motion::FindPath(
            scene, {.from = execution.commanded(), .to = q, .rules = rules, .budget = 20'000});
        if (auto* path = std::get_if<motion::JointPath>(&way)) return std::move(*path);
      }
    }
    return std::nullopt;
  }

  // What points up in the hand is to point up all the way.
  motion::MotionRules RulesFor(const Pose& X_WorldHeld, const plan::Hold& hold) const {
    motion::MotionRules rules{.clearance = kClearance};
    if (!tilt_) return rules;
    const Pose X_WorldTool = X_WorldHeld * hold.X_PartTool;
    rules.upright = {.up_Tool = X_WorldTool.linear().transpose() * Vector3::UnitZ(),
                     .tilt = *tilt_};
    return rules;
  }

  // As it is held, turned about the vertical and over the place, on the table.
  static std::vector<Pose> FreePlaces(const domain::Table& table, const domain::Problem& problem,
                                      PartId id, const Pose& X_WorldHeld,
                                      const std::vector<domain::PlacedPart>& standing) {
    const domain::Part& part = problem.part(id);
    const auto is_free = [&](const Pose& X_WorldPart) {
      if (!domain::IsOver(table, part, X_WorldPart)) return false;
      const geometry::Polygon footprint = domain::Footprint(part, X_WorldPart);
      return std::ranges::all_of(standing, [&](const domain::PlacedPart& other) {
        const domain::Part& neighbour = problem.part(other.part);
        return geometry::Gap(footprint, domain::Footprint(neighbour, other.X_WorldPart)) >
               kHandRoom;
      });
    };
    double lowest = 1e9;
    for (const Vector3& vertex : part.model->hull().vertices) {
      lowest = std::min(lowest, (X_WorldHeld.linear() * vertex).z());
    }
    std::vector<Pose> free;
    for (const Vector2& place : PlacesOn(table)) {
      for (int i = 0; i < kYaws; ++i) {
        Pose X_WorldPart = geometry::RotationZ(2 * std::numbers::pi * i / kYaws) * X_WorldHeld;
        X_WorldPart.translation() = Vector3(place.x(), place.y(), -lowest);
        if (is_free(X_WorldPart)) free.push_back(X_WorldPart);
      }
    }
    return free;
  }

  static exec::Progress Follow(const motion::JointPath& path, exec::Execution& execution) {
    const motion::JointRates rates = motion::RatesOf(*execution.problem().workcell);
    return execution.Follow(motion::AlongPath(path, rates), 0);
  }

  const domain::Table* to_;     // null: the action's
  std::optional<double> tilt_;  // greatest on the way, radians; none: any
};

}  // namespace

const SkillWord kCarry = {
    .name = "carry",
    .summary =
        "goes with the held part over a free place of the table `to`, or of the arguments; "
        "never tilted by more than `upright`",
    .read = [](const Value& map, const SkillContext& context) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill", "to", "upright"});
      const auto to = map.Find("to");
      const auto upright = map.Find("upright");
      std::optional<double> tilt;
      if (upright) tilt = domain::ReadWithin(*upright, context.units.angle, kTilts);
      return std::make_unique<Carry>(to ? &ReadTable(*to, context.problem) : nullptr, tilt);
    },
};

}  // namespace assay::enact
