#include "sim/execution/predicates/predicate.h"

#include <array>
#include <vector>

#include "planner/domain/resting/resting.h"

namespace assay::execution {

scene::Scene Truth::SceneOf(RobotId robot) const {
  return robot.IsNone() ? scene : scene.WorkedBy(robot);
}

bool Truth::StandsAt(PartId part, const domain::Place& place) const {
  const geometry::Pose X_WorldPart = scene.TruePose(data, part);
  const geometry::Vector2 off =
      X_WorldPart.translation().head<2>() - geometry::Vector2(place.middle.x, place.middle.y);
  return off.norm() <= place.radius &&
         domain::StablePoseAt(problem.part(part), X_WorldPart) == problem.part(part).resting;
}

std::span<const PredicateWord* const> PredicateWords() {
  static constexpr std::array kWords = {&kInternal, &kHeld,    &kHandEmpty, &kOver,
                                        &kHeavier,  &kColored, &kAt,        &kOccupied};
  return kWords;
}

std::unique_ptr<const Predicate> ReadPredicate(const Value& map, const PredicateContext& context) {
  std::vector<std::string> names;
  for (const PredicateWord* word : PredicateWords()) names.emplace_back(word->name);
  const int word = map.At("is").OneOf(names);
  return PredicateWords()[static_cast<std::size_t>(word)]->read(map, context);
}

const PredicateWord kInternal = {
    .name = "internal",
    .summary =
        "for a predicate or a numeric function that has no meaning in the workcell: it is not "
        "audited",
    .read = [](const Value& map, const PredicateContext&) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is"});
      return nullptr;
    },
};

}  // namespace assay::execution
