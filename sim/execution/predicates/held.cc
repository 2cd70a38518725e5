#include "sim/execution/predicates/meaning.h"

namespace assay::execution {
namespace {

class Held : public Meaning {
 public:
  std::string Lacks(const Roles& roles) const override { return roles.part.IsNone() ? "part" : ""; }
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    const scene::Scene scene = truth.SceneOf(roles.robot);
    return scene.Touching(truth.data, roles.part, scene.left_finger()) &&
           scene.Touching(truth.data, roles.part, scene.right_finger());
  }
};

}  // namespace

const MeaningWord kHeld = {
    .name = "held",
    .summary = "both fingers touch the part: those of the robot of the arguments",
    .read = [](const Value& map, const MeaningContext&) -> std::unique_ptr<const Meaning> {
      map.AllowOnly({"is"});
      return std::make_unique<Held>();
    },
};

}  // namespace assay::execution
