#include "sim/enact/skill.h"

namespace assay::enact {
namespace {

// The arm that acts goes home, out of the camera's sight; the others are there. What cannot be told
// is as if nobody had looked.
class Look : public Skill {
 public:
  exec::Progress Do(const Roles& roles, Situation& situation) const override {
    if (auto failure = situation.crew.GoHome()) return failure;
    const exec::Execution& execution = situation.execution();
    const exec::Pose believed = execution.world().PartPose(roles.part, execution.BelievedTool());
    const sense::ColorId color =
        situation.color_sensor->Measure(situation.execution().data(), roles.part, believed);
    situation.readings.colors.erase(roles.part);
    if (!color.IsNone()) situation.readings.colors[roles.part] = color;
    return std::nullopt;
  }
};

}  // namespace

const SkillWord kLook = {
    .name = "look",
    .summary =
        "looks with the overhead camera which of the scenario's `colors` the part has, the "
        "arms at their homes",
    .read = [](const Value& map, const SkillContext& context) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill"});
      if (context.colors.empty()) map.Fail("there are no colours to tell", "a key colors");
      return std::make_unique<Look>();
    },
};

}  // namespace assay::enact
