#include "sim/execution/skills/skill.h"

#include <array>

#include "sim/execution/commands/run.h"
#include "sim/execution/commands/travel.h"

namespace assay::execution {

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
Progress Travel(const MoveAtSafeHeight& move, std::span<const Command> rest, Execution& execution) {
  motion::TravelRequest request = RequestFor(move, rest, execution);
  request.is_arm_watched = true;
  return Go(motion::PlanTravel(execution.problem(), execution.BelievedSurroundings(), request),
            execution);
}

Progress Run(const Command& command, std::span<const Command> rest, Execution& execution) {
  if (const auto* move = std::get_if<MoveAtSafeHeight>(&command)) {
    return Travel(*move, rest, execution);
  }
  return std::visit([&](const auto& other) { return execution::Run(other, rest, execution); },
                    command);
}

}  // namespace

Progress RunAll(const std::vector<Command>& commands, Execution& execution) {
  const std::span<const Command> all(commands);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (Progress failure = Run(all[i], all.subspan(i + 1), execution)) return failure;
  }
  return std::nullopt;
}

}  // namespace assay::execution
