#include "sim/execution/predicates/quantity.h"

namespace assay::execution {
namespace {

class Mass : public Quantity {
 public:
  std::string Lacks(const Roles& roles) const override { return roles.part.IsNone() ? "part" : ""; }
  double TrueValue(const Truth& truth, const Roles& roles) const override {
    return truth.scene.TrueMass(roles.part);
  }
  std::optional<Reading> Observed(const Readings& readings, const Roles& roles) const override {
    const auto found = readings.masses.find(roles.part);
    if (found == readings.masses.end()) return std::nullopt;
    return found->second;
  }
  void Shift(Readings& readings, const Roles& roles, double by) const override {
    readings.masses.at(roles.part).value += by;
  }
  void Narrow(HiddenKinds& kinds, const Interval& within) const override {
    KeepMasses(within, kinds);
  }
};

}  // namespace

const QuantityWord kMass = {
    .name = "mass",
    .summary = "for a numeric function: the part's mass in kg; observed by weigh",
    .read = [](const Value& map) -> std::unique_ptr<const Quantity> {
      map.AllowOnly({"is"});
      return std::make_unique<Mass>();
    },
};

}  // namespace assay::execution
