#include "sim/enact/skills/skill.h"

#include <array>

#include "sim/exec/execution/travel.h"

namespace assay::enact {

std::span<const SkillWord* const> SkillWords() {
  static constexpr std::array kWords = {&kPickUp, &kWeigh, &kCarry, &kPutDown, &kLook};
  return kWords;
}

std::unique_ptr<const Skill> ReadSkill(const Value& map, const SkillContext& context) {
  std::vector<std::string> names;
  for (const SkillWord* word : SkillWords()) names.emplace_back(word->name);
  return SkillWords()[static_cast<std::size_t>(map.At("skill").OneOf(names))]->read(map, context);
}

namespace {

// The whole arm is checked for collisions, because no plan has checked this travel before.
exec::Progress Travel(const exec::MoveAtSafeHeight& move, std::span<const exec::Command> rest,
                      exec::Execution& execution) {
  motion::TravelRequest request = exec::RequestFor(move, rest, execution);
  request.is_arm_watched = true;
  return exec::Go(
      motion::PlanTravel(execution.problem(), execution.BelievedSurroundings(), request),
      execution);
}

exec::Progress Run(const exec::Command& command, std::span<const exec::Command> rest,
                   exec::Execution& execution) {
  if (const auto* move = std::get_if<exec::MoveAtSafeHeight>(&command)) {
    return Travel(*move, rest, execution);
  }
  return std::visit([&](const auto& other) { return exec::Run(other, rest, execution); }, command);
}

}  // namespace

exec::Progress RunAll(const std::vector<exec::Command>& commands, exec::Execution& execution) {
  const std::span<const exec::Command> all(commands);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (exec::Progress failure = Run(all[i], all.subspan(i + 1), execution)) return failure;
  }
  return std::nullopt;
}

}  // namespace assay::enact
