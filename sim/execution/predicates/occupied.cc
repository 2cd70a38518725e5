#include "sim/execution/predicates/predicate.h"

namespace assay::execution {
namespace {

class Occupied : public Predicate {
 public:
  std::string Lacks(const Roles& roles) const override {
    return roles.place == nullptr ? "place" : "";
  }
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    int standing = 0;
    for (int i = 0; i < truth.scene.part_count(); ++i) {
      standing += truth.StandsAt(PartId(i), *roles.place);
    }
    return standing >= roles.place->room;
  }
};

}  // namespace

const PredicateWord kOccupied = {
    .name = "occupied",
    .summary = "the place is full: it has no room for another part",
    .read = [](const Value& map, const PredicateContext&) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is"});
      return std::make_unique<Occupied>();
    },
};

}  // namespace assay::execution
