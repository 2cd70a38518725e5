#include "sim/execution/skills/skill.h"

namespace assay::execution {
namespace {

constexpr double kCalmDown = 0.3;  // seconds for the arm to come to rest
constexpr double kDuration = 0.2;  // seconds over which the wrist's force is averaged
constexpr double kDefaultError = 0.2;
constexpr domain::Range kErrors = {0, 50};  // newtons

// When the arm holds still, the part pulls at the wrist with its weight.
class Weigh : public Skill {
 public:
  explicit Weigh(double error) : error_(error) {}

  Progress Do(const Roles& roles, Situation& situation) const override {
    Execution& execution = situation.execution();
    if (auto failure = execution.Stay(kCalmDown)) return failure;
    double impulse = 0;
    const double begin = execution.data().time();
    while (execution.data().time() < begin + kDuration) {
      if (auto failure = execution.Stay(0)) return failure;
      impulse -=
          execution.scene().WristWrench(execution.data()).force.z() * execution.data().timestep();
    }
    const double force = impulse / (execution.data().time() - begin) +
                         situation.sensor_noise.Uniform(-error_, error_);
    situation.readings.masses[roles.part] = {force / scene::kGravity, error_ / scene::kGravity};
    return std::nullopt;
  }

 private:
  double error_;  // the greatest error of the wrist's force, newtons
};

}  // namespace

const SkillWord kWeigh = {
    .name = "weigh",
    .summary =
        "holds the part still and reads its weight at the wrist; the reading is off by at most "
        "`error` newtons",
    .read = [](const Value& map, const SkillContext&) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill", "error"});
      const auto error = map.Find("error");
      return std::make_unique<Weigh>(error ? domain::ReadWithin(*error, domain::kNewtons, kErrors)
                                           : kDefaultError);
    },
};

}  // namespace assay::execution
