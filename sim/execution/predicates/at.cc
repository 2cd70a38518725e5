#include "sim/execution/predicates/predicate.h"

namespace assay::execution {
namespace {

class At : public Predicate {
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

const PredicateWord kAt = {
    .name = "at",
    .summary = "the part stands within the place, in the stable pose that it had at the start",
    .read = [](const Value& map, const PredicateContext&) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is"});
      return std::make_unique<At>();
    },
};

}  // namespace assay::execution
