#include "sim/execution/predicates/meaning.h"

namespace assay::execution {
namespace {

class At : public Meaning {
 public:
  std::string Lacks(const Roles& roles) const override {
    if (roles.part.IsNone()) return "part";
    return roles.place == nullptr ? "place" : "";
  }
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    return truth.StandsAt(roles.part, *roles.place);
  }
};

}  // namespace

const MeaningWord kAt = {
    .name = "at",
    .summary = "the part stands within the place, as it stood at the start",
    .read = [](const Value& map, const MeaningContext&) -> std::unique_ptr<const Meaning> {
      map.AllowOnly({"is"});
      return std::make_unique<At>();
    },
};

}  // namespace assay::execution
