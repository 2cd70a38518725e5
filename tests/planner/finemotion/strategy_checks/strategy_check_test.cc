#include "planner/finemotion/strategy_checks/strategy_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/workloads/pegs.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"

namespace assay::finemotion::strategy_check_test {
namespace {

using plan::Strategy;
using plan::StrategyMotion;
using plan::UnwantedContact;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLength = 0.07;  // length of the peg, metres

MatingGeometry SquarePeg() {
  MatingGeometry geometry;
  geometry.passage = workloads::PegInHole({.half = 0.01905, .length = kLength}, 0.25e-3);
  geometry.X_FixedSeat = geometry::Translation(-kLength * Vector3::UnitZ());
  return geometry;
}

// Half widths of all displacements (metres) and turns (radians), and the seed of the search.
struct Asked {
  double length = 0;
  double angle = 0;
  std::uint64_t seed = 1;
};

// Returns a strategy, or none if none was found.
std::optional<Strategy> StrategyFor(const MatingGeometry& geometry, const Asked& asked) {
  const plan::StrategyCertificate certificate = {.d = Vector3::Constant(asked.length),
                                                 .w = Vector3::Constant(asked.angle),
                                                 .velocity = FineMotionErrors().velocity};
  const FineMotionPlan plan =
      SearchStrategy(geometry.passage, ErrorsOf(certificate, geometry), {.seed = asked.seed});
  if (!plan.found()) return std::nullopt;
  Strategy strategy = StrategyOf(geometry, plan);
  strategy.certificate = certificate;
  strategy.certificate.absorbed = plan.absorbed;
  strategy.certificate.friction = plan.friction_limit;
  return strategy;
}

// A strategy that the search found has no flaws in the replay.
TEST(FlawsOfStrategy, WhatWasFoundHasNone) {
  const MatingGeometry geometry = SquarePeg();
  for (const auto& [length, seeds] : {std::pair(1e-3, 8U), std::pair(2e-3, 20U)}) {
    unsigned found = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto strategy = StrategyFor(geometry, {length, length / 2e-3 * kDegree, seed});
      if (!strategy) continue;
      EXPECT_THAT(FlawsOfStrategy(geometry, *strategy), IsEmpty()) << length << ' ' << seed;
      ++found;
    }
    EXPECT_GE(found, seeds - 2) << length;
  }
}

// The models have several critical points. Some sequences were found for larger errors than
// requested.
TEST(FlawsOfStrategy, WhatWasFoundForModelsHasNone) {
  for (const char* scenario : {"mate-stepped", "mate-t-slot"}) {
    const domain::Problem problem =
        domain::ReadProblem(Document::Load(domain::ScenarioPath(scenario)), domain::ModelsFolder(),
                            {.clearance = 0.5e-3});
    const MatingGeometry geometry = GeometryOf(problem, problem.matings.front());
    const auto strategy = StrategyFor(geometry, {0.3e-3, 0.15 * kDegree, 1});
    ASSERT_TRUE(strategy) << scenario;
    EXPECT_THAT(FlawsOfStrategy(geometry, *strategy), IsEmpty()) << scenario;
  }
}

// --- Strategies that were changed by hand.

class Tampered : public testing::Test {
 protected:
  std::vector<std::string> After(const std::function<void(Strategy&)>& change) const {
    Strategy strategy = strategy_;
    change(strategy);
    EXPECT_THAT(plan::FlawsOfForm(strategy), IsEmpty());
    return FlawsOfStrategy(geometry_, strategy);
  }
  // Returns the flaws in words after a change of one motion.
  std::vector<std::string> AfterMotion(std::size_t index,
                                       const std::function<void(StrategyMotion&)>& change) const {
    return After([&](Strategy& strategy) { change(strategy.motions[index]); });
  }
  // Returns the index of the first motion with this property.
  std::size_t First(const std::function<bool(const StrategyMotion&)>& is) const {
    return static_cast<std::size_t>(std::ranges::find_if(strategy_.motions, is) -
                                    strategy_.motions.begin());
  }
  std::string Named(std::size_t motion) const {
    return "motion " + std::to_string(motion + 1) + ": ";
  }

  const MatingGeometry geometry_ = SquarePeg();
  const Strategy strategy_ = StrategyFor(geometry_, {2e-3, kDegree}).value();
  const std::size_t waiting_ = First([](const StrategyMotion& m) { return m.until.has_value(); });
  const std::size_t keeping_ = First([](const StrategyMotion& m) { return !m.kept.empty(); });
  const std::size_t warned_ = First([](const StrategyMotion& m) { return !m.unwanted.empty(); });
};

TEST_F(Tampered, ErrorsAreTooGreat) {
  EXPECT_THAT(After([](Strategy& s) { s.certificate.d *= 2; }), Contains(HasSubstr("motion ")));
  EXPECT_THAT(After([](Strategy& s) { s.certificate.w *= 2; }), Contains(HasSubstr("motion ")));
  for (const int axis : {0, 1}) {
    EXPECT_THAT(After([&](Strategy& s) { s.certificate.d[axis] *= 2; }),
                Contains(HasSubstr("motion ")));
  }
  EXPECT_THAT(After([](Strategy& s) { s.certificate.velocity = 0.2; }),
              Contains(HasSubstr("motion ")));
  EXPECT_THAT(After([](Strategy& s) { s.certificate.friction = 5; }),
              Contains(HasSubstr("and it is said to take 5")));
  EXPECT_THAT(After([](Strategy& s) { s.certificate.absorbed = 2; }),
              Contains(testing::AllOf(HasSubstr("motion "), HasSubstr("with 2 times the errors"))));
}

TEST_F(Tampered, WaysLeadElsewhere) {
  EXPECT_THAT(After([](Strategy& s) { s.X_FixedStart.translation().x() += 2e-3; }),
              Contains(StartsWith("motion ")));
  EXPECT_THAT(After([](Strategy& s) { s.X_FixedStart.translation().z() -= 8e-3; }),
              Contains(HasSubstr("the start is not surely free")));
  EXPECT_THAT(
      AfterMotion(waiting_, [](StrategyMotion& m) { m.X_FixedTip.translation().z() += 1e-3; }),
      Contains(StartsWith(Named(waiting_))));
  EXPECT_THAT(AfterMotion(keeping_,
                          [](StrategyMotion& m) {
                            m.X_FixedTip.rotate(Eigen::AngleAxisd(3 * kDegree, Vector3::UnitX()));
                          }),
              Contains(StartsWith(Named(keeping_))));
  EXPECT_THAT(After([](Strategy& s) { s.motions.back().X_FixedTip.translation().z() += 1e-3; }),
              Contains(HasSubstr("the seat")));
  EXPECT_THAT(After([](Strategy& s) { s.X_HeldTip.translation().x() += 1e-3; }),
              Contains(HasSubstr("tip")));
}

TEST_F(Tampered, MotionsAreMissing) {
  EXPECT_THAT(After([](Strategy& s) { s.motions.pop_back(); }), Contains(HasSubstr("slide in")));
  EXPECT_THAT(
      After([](Strategy& s) { s.motions.erase(s.motions.begin() + 3, s.motions.end() - 1); }),
      Contains(HasSubstr("the way in is not surely free")));
}

TEST_F(Tampered, StatesAreOthers) {
  EXPECT_THAT(AfterMotion(keeping_,
                          [](StrategyMotion& m) {
                            std::erase_if(m.unwanted, &UnwantedContact::is_loss);
                            m.kept.clear();
                          }),
              Contains(StartsWith(Named(keeping_))));
  const auto is_made = [](const UnwantedContact& u) { return !u.is_loss; };
  const std::size_t either = First(
      [&](const StrategyMotion& m) { return m.until && std::ranges::any_of(m.unwanted, is_made); });
  EXPECT_THAT(AfterMotion(either,
                          [&](StrategyMotion& m) {
                            m.until = std::ranges::find_if(m.unwanted, is_made)->contact;
                            m.unwanted.clear();
                          }),
              Contains(StartsWith(Named(either))));
  EXPECT_THAT(AfterMotion(waiting_,
                          [](StrategyMotion& m) {
                            std::erase_if(m.unwanted, &UnwantedContact::is_loss);
                            m.until.reset();
                          }),
              Contains(StartsWith(Named(waiting_))));
  EXPECT_THAT(AfterMotion(waiting_, [](StrategyMotion& m) { m.beyond = 0; }),
              Contains(StartsWith(Named(waiting_))));
  EXPECT_THAT(AfterMotion(0, [](StrategyMotion& m) { m.slides = true; }),
              Contains(StartsWith(Named(0))));
}

TEST_F(Tampered, UnwantedContactsAreNotTold) {
  EXPECT_THAT(AfterMotion(warned_, [](StrategyMotion& m) { m.unwanted.erase(m.unwanted.begin()); }),
              Contains(StartsWith(Named(warned_) + "the file does not name contact ")));
  EXPECT_THAT(AfterMotion(warned_, [](StrategyMotion& m) { m.unwanted[0].scale += 1; }),
              Contains(HasSubstr("times the errors, and may be with ")));
  EXPECT_THAT(AfterMotion(warned_, [](StrategyMotion& m) { m.unwanted[0].gap += 1e-3; }),
              Contains(HasSubstr("the gap of ")));
}

TEST_F(Tampered, ContactsAreElsewhere) {
  const auto until = static_cast<std::size_t>(*strategy_.motions[waiting_].until);
  const auto after = [&](const std::function<void(plan::StrategyContact&)>& change) {
    return After([&](Strategy& s) { change(s.contacts[until]); });
  };
  const std::string name = strategy_.contacts[until].name;
  EXPECT_THAT(after([](auto& contact) { contact.normal *= -1; }),
              Contains(StartsWith(Named(waiting_) + "the normal of " + name)));
  EXPECT_THAT(after([](auto& contact) { contact.at.x() += 1e-3; }),
              Contains(StartsWith(Named(waiting_) + name + " is 1 mm from")));
  EXPECT_THAT(after([](auto& contact) { contact.name = "vertex 999 on face 0"; }),
              Contains(StartsWith(Named(waiting_) + "contact vertex 999 on face 0")));
  EXPECT_THAT(after([](auto& contact) { contact.name = "corner 1"; }),
              Contains("'corner 1' is no contact's name"));
}

}  // namespace
}  // namespace assay::finemotion::strategy_check_test
