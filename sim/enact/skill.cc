#include "sim/enact/skill.h"

#include <array>
#include <span>

namespace assay::enact {

std::vector<domain::PlacedPart> Situation::Standing(PartId but) const {
  std::vector<domain::PlacedPart> standing;
  for (int i = 0; i < execution().world().part_count(); ++i) {
    const PartId part(i);
    if (part != but) standing.push_back({part, execution().world().PartPose(part)});
  }
  return standing;
}

std::unique_ptr<const Skill> ReadSkill(const Value& map, const SkillContext& context) {
  static constexpr std::array kWords = {&kPickUp, &kWeigh, &kCarry, &kPutDown, &kLook};
  std::vector<std::string> names;
  for (const SkillWord* word : kWords) names.emplace_back(word->name);
  return kWords[static_cast<std::size_t>(map.At("skill").OneOf(names))]->read(map, context);
}

exec::Progress RunAll(const std::vector<exec::Command>& commands, exec::Execution& execution) {
  const std::span<const exec::Command> all(commands);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto run = [&](const auto& command) {
      return exec::Run(command, all.subspan(i + 1), execution);
    };
    if (exec::Progress failure = std::visit(run, all[i])) return failure;
  }
  return std::nullopt;
}

}  // namespace assay::enact
