#include "sim/execution/predicates/predicate.h"

namespace assay::execution {
namespace {

class Colored : public Predicate {
 public:
  Colored(sense::ColorId color, const sense::NamedColor& named) : color_(color), named_(named) {}

  std::string Lacks(const Roles& roles) const override { return roles.part.IsNone() ? "part" : ""; }
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    const auto& colors = truth.scene.options().part_colors;
    const auto found = colors.find(roles.part);
    return found != colors.end() && found->second.head<3>() == named_.color;
  }
  bool IsObservable() const override { return true; }
  std::optional<bool> Observed(const Readings& readings, const Roles& roles) const override {
    const auto found = readings.colors.find(roles.part);
    if (found == readings.colors.end()) return std::nullopt;
    return found->second == color_;
  }
  void Narrow(HiddenKinds& kinds, bool wanted) const override {
    std::erase_if(kinds.colors, [&](sense::ColorId kind) { return (kind == color_) != wanted; });
  }

 private:
  sense::ColorId color_;
  sense::NamedColor named_;
};

}  // namespace

const PredicateWord kColored = {
    .name = "colored",
    .summary = "the part has the `color`, one of the scenario's `colors`; observed by look",
    .read = [](const Value& map,
               const PredicateContext& context) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is", "color"});
      const sense::ColorId color = ReadColorName(map.At("color"), context.colors);
      return std::make_unique<Colored>(color, context.colors[color.index()]);
    },
};

}  // namespace assay::execution
