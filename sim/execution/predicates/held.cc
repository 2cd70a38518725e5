#include "sim/execution/predicates/predicate.h"

namespace assay::execution {
namespace {

class Held : public Predicate {
 public:
  std::string Lacks(const Roles& roles) const override { return roles.part.IsNone() ? "part" : ""; }
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    const scene::Scene scene = truth.SceneOf(roles.robot);
    return scene.Touching(truth.data, roles.part, scene.left_finger()) &&
           scene.Touching(truth.data, roles.part, scene.right_finger());
  }
};

}  // namespace

const PredicateWord kHeld = {
    .name = "held",
    .summary =
        "both fingers touch the part; with a robot among the arguments, only its fingers count",
    .read = [](const Value& map, const PredicateContext&) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is"});
      return std::make_unique<Held>();
    },
};

}  // namespace assay::execution
