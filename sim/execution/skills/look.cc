#include "sim/execution/skills/skill.h"

namespace assay::execution {
namespace {

// The acting robot goes home, out of the camera's sight. The other robots are at their homes
// already. A part whose colour the camera cannot determine has no reading afterwards.
class LookAtColors : public Skill {
 public:
  Progress Do(const Roles& roles, Situation& situation) const override {
    if (auto failure = situation.robots.GoHome()) return failure;
    for (const PartId part : roles.parts) LookAt(part, situation);
    return std::nullopt;
  }

 private:
  static void LookAt(PartId part, Situation& situation) {
    Execution& execution = situation.execution();
    const Pose believed = execution.world().PartPose(part, execution.BelievedTool());
    const sense::ColorId color = situation.color_sensor->Measure(execution.data(), part, believed);
    situation.readings.colors.erase(part);
    if (!color.IsNone()) situation.readings.colors[part] = color;
  }
};

}  // namespace

const SkillWord kLook = {
    .name = "look",
    .summary =
        "sends the arm home, and determines with the overhead camera which of the scenario's "
        "`colors` each part has",
    .read = [](const Value& map, const SkillContext& context) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill"});
      if (context.colors.empty()) map.Fail("there are no colours to tell", "a key colors");
      return std::make_unique<LookAtColors>();
    },
};

}  // namespace assay::execution
