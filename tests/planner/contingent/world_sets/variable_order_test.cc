#include "planner/contingent/world_sets/variable_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::variable_order_test {
namespace {

// Each illness has a symptom, which a stain makes visible. The observation of a symptom is a
// separate atom.
constexpr const char* kDomain =
    "domain symptoms types: illness predicates: has(illness), shows(illness), idle "
    "constants: a, b, c, d: illness "
    "action stain effects: forall (?i: illness) K(has(?i)) => add(Kf, shows(?i)) "
    "action look(?i: illness) effects: add(Kw, shows(?i))";
constexpr const char* kProblem =
    "problem symptoms domain symptoms "
    "init: add(Kf, !idle), add(LCW, shows(?i)), add(Kx, has(a) | has(b) | has(c) | has(d)) "
    "goal: K(has(a)) | K(!has(a))";

int PlaceOf(const GroundTask& task, const std::vector<int>& places, const std::string& atom) {
  const auto found = std::ranges::find(task.atoms, atom);
  EXPECT_NE(found, task.atoms.end()) << atom;
  return places[found - task.atoms.begin()];
}

TEST(VariableOrder, IsAPermutation) {
  const GroundTask task = GroundText(kDomain, kProblem);
  std::vector<int> places = PlacesOfAtoms(task);
  std::ranges::sort(places);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(places[i], static_cast<int>(i));
  EXPECT_EQ(places.size(), task.atoms.size());
}

TEST(VariableOrder, SymptomsStandBehindTheirIllness) {
  const GroundTask task = GroundText(kDomain, kProblem);
  const std::vector<int> places = PlacesOfAtoms(task);
  for (const char* illness : {"a", "b", "c", "d"}) {
    const std::string of = std::string("(") + illness + ")";
    EXPECT_EQ(PlaceOf(task, places, "shows" + of), PlaceOf(task, places, "has" + of) + 1) << of;
  }
}

}  // namespace
}  // namespace assay::contingent::variable_order_test
