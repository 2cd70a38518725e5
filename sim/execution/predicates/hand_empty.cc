#include "sim/execution/predicates/meaning.h"

namespace assay::execution {
namespace {

class HandEmpty : public Meaning {
 public:
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    const scene::Scene scene = truth.SceneOf(roles.robot);
    for (int i = 0; i < scene.part_count(); ++i) {
      if (scene.Touching(truth.data, PartId(i), scene.left_finger()) ||
          scene.Touching(truth.data, PartId(i), scene.right_finger())) {
        return false;
      }
    }
    return true;
  }
};

}  // namespace

const MeaningWord kHandEmpty = {
    .name = "hand-empty",
    .summary = "no finger touches a part: of the robot of the arguments",
    .read = [](const Value& map, const MeaningContext&) -> std::unique_ptr<const Meaning> {
      map.AllowOnly({"is"});
      return std::make_unique<HandEmpty>();
    },
};

}  // namespace assay::execution
