#include <cmath>
#include <limits>

#include "planner/domain/units/units.h"
#include "sim/execution/predicates/predicate.h"

namespace assay::execution {
namespace {

class Heavier : public Predicate {
 public:
  explicit Heavier(double mass) : mass_(mass) {}

  std::string Lacks(const Roles& roles) const override { return roles.part.IsNone() ? "part" : ""; }
  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    return truth.scene.TrueMass(roles.part) > mass_;
  }
  bool IsObservable() const override { return true; }
  std::optional<bool> Observed(const Readings& readings, const Roles& roles) const override {
    const auto found = readings.masses.find(roles.part);
    if (found == readings.masses.end()) return std::nullopt;
    const auto& [value, error] = found->second;
    if (std::abs(value - mass_) <= error) return std::nullopt;
    return value > mass_;
  }
  void Narrow(HiddenKinds& kinds, bool wanted) const override {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const Interval heavier = {std::nextafter(mass_, kInfinity), kInfinity};
    KeepMasses(wanted ? heavier : Interval{0, mass_}, kinds);
  }

 private:
  double mass_;  // kg
};

}  // namespace

const PredicateWord kHeavier = {
    .name = "heavier",
    .summary = "the part's mass is more than `than`, in kg; observed by weigh",
    .read = [](const Value& map, const PredicateContext&) -> std::unique_ptr<const Predicate> {
      map.AllowOnly({"is", "than"});
      return std::make_unique<Heavier>(
          domain::ReadWithin(map.At("than"), domain::kKilograms, {0.001, 10}));
    },
};

}  // namespace assay::execution
