#include "sim/execution/predicates/predicate.h"

namespace assay::execution {
namespace {

class HandEmpty : public Predicate {
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

const PredicateWord kHandEmpty = {
    .name = "hand-empty",
    .summary = "no finger touches a part; with a robot among the arguments, only its fingers count",
    .read = [](const Value& map, const PredicateContext&) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is"});
      return std::make_unique<HandEmpty>();
    },
};

}  // namespace assay::execution
