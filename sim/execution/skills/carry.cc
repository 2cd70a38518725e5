#include "planner/motion/handling/carry.h"

#include <fmt/format.h>

#include <numbers>
#include <variant>

#include "planner/motion/paths/joint_trajectory.h"
#include "sim/execution/skills/skill.h"

namespace assay::execution {
namespace {

constexpr domain::Range kUprightTilts = {std::numbers::pi / 1800, std::numbers::pi / 2};

class Carry : public Skill {
 public:
  Carry(const domain::Table* to, std::optional<double> tilt) : to_(to), tilt_(tilt) {}

  std::string Lacks(const Roles& roles) const override {
    if (roles.part.IsNone()) return "part";
    return to_ == nullptr && roles.table == nullptr ? "table" : "";
  }

  Progress Do(const Roles& roles, Situation& situation) const override {
    Execution& execution = situation.execution();
    const domain::Problem& problem = situation.problem();
    const std::string& name = problem.part(roles.part).name;
    if (execution.world().held() != roles.part) {
      return Failure{TrialOutcome::kUnreachable, name + " is not in the hand"};
    }
    const domain::Table& table = to_ != nullptr ? *to_ : *roles.table;
    const motion::TravelResult way = motion::PlanCarry(problem, execution.BelievedSurroundings(),
                                                       {.from = execution.commanded(),
                                                        .table = table,
                                                        .tilt = tilt_,
                                                        .X_BelievedTool = execution.hand_error()});
    if (const auto* why = std::get_if<std::string>(&way)) {
      return Failure{
          TrialOutcome::kUnreachable,
          fmt::format("no way to a free place on {} for {}: {}", table.name, name, *why)};
    }
    const motion::JointRates rates = motion::RatesOf(*problem.workcell);
    return execution.Follow(motion::AlongPath(std::get<motion::JointPath>(way), rates));
  }

 private:
  const domain::Table* to_;     // null: the table of the action's arguments
  std::optional<double> tilt_;  // the greatest tilt on the way, radians; none: any tilt
};

}  // namespace

const SkillWord kCarry = {
    .name = "carry",
    .summary =
        "carries the held part over a free place of the table `to`, or of the table among the "
        "arguments, where the arm can put it down; never tilts it by more than `upright`",
    .read = [](const Value& map, const SkillContext& context) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill", "to", "upright"});
      const auto to = map.Find("to");
      const auto upright = map.Find("upright");
      std::optional<double> tilt;
      if (upright) tilt = domain::ReadWithin(*upright, context.units.angle, kUprightTilts);
      return std::make_unique<Carry>(to ? &ReadTable(*to, context.problem) : nullptr, tilt);
    },
};

}  // namespace assay::execution
