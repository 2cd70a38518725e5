#include "planner/domain/resting/resting.h"
#include "sim/execution/predicates/predicate.h"

namespace assay::execution {
namespace {

// A part that is carried above a table is over it, just like a part that stands on it.
class Over : public Predicate {
 public:
  explicit Over(const domain::Table* table) : table_(table) {}

  std::string Lacks(const Roles& roles) const override {
    if (roles.part.IsNone()) return "part";
    return table_ == nullptr && roles.table == nullptr ? "table" : "";
  }
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    const domain::Table& table = table_ != nullptr ? *table_ : *roles.table;
    return domain::IsOver(table, truth.problem.part(roles.part),
                          truth.scene.TruePose(truth.data, roles.part));
  }

 private:
  const domain::Table* table_;  // null: the table of the atom's arguments
};

}  // namespace

const PredicateWord kOver = {
    .name = "over",
    .summary =
        "the part's whole vertical projection is on the table `place`, or on the table among the "
        "arguments",
    .read = [](const Value& map,
               const PredicateContext& context) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is", "place"});
      const std::optional<Value> place = map.Find("place");
      return std::make_unique<Over>(place ? &ReadTable(*place, context.problem) : nullptr);
    },
};

}  // namespace assay::execution
