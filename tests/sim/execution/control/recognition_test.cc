#include "sim/execution/control/recognition.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"

namespace assay::execution::recognition_test {
namespace {

constexpr double kFriction = 0.2;

// Returns a wrench that a contact can exert, about the tip's origin. It has no friction if `random`
// is null.
Vector6 ForceOf(const plan::StrategyContact& contact, double pressure, RandomStream* random) {
  Vector3 force = contact.normal;
  if (random != nullptr) {
    const Vector3 any(random->Uniform(-1, 1), random->Uniform(-1, 1), random->Uniform(-1, 1));
    const double share = kFriction * std::sqrt(random->Uniform());
    force += share * contact.normal.cross(any).normalized();
  }
  return pressure * Joined(force, contact.at.cross(force));
}

// Returns a strategy of one motion. It keeps a contact below the tip and waits for another one.
// Three walls and a second contact below are unwanted. The motion leads to within 1 mm of each.
plan::Strategy SomeStrategy() {
  const auto contact = [](const char* name, const Vector3& normal, const Vector3& at) {
    return plan::StrategyContact{name, normal, at};
  };
  plan::Strategy strategy{.X_HeldTip = Pose::Identity(),
                          .X_FixedStart = Pose::Identity(),
                          .contacts = {contact("kept", Vector3::UnitZ(), {0.02, 0.02, 0}),
                                       contact("awaited", Vector3::UnitZ(), {-0.02, 0.02, 0}),
                                       contact("right", -Vector3::UnitX(), {0.02, 0, 0.005}),
                                       contact("left", Vector3::UnitX(), {-0.02, 0, 0.005}),
                                       contact("behind", -Vector3::UnitY(), {0, 0.02, 0.005}),
                                       contact("below", Vector3::UnitZ(), {0.02, -0.02, 0})},
                          .motions = {},
                          .friction = kFriction};
  plan::StrategyMotion motion{.kept = {0}, .X_FixedTip = Pose::Identity(), .until = 1};
  for (int i = 2; i < 6; ++i) {
    motion.unwanted.push_back({.contact = i, .scale = 1.5, .gap = 1e-3, .separation = 0.5});
  }
  motion.unwanted.push_back({.contact = 0, .is_loss = true, .scale = 2});
  strategy.motions = {motion};
  return strategy;
}

std::string NameOf(const plan::Strategy& strategy, const Vector6& wrench) {
  const auto found = Recognize(strategy, strategy.motions[0], wrench);
  if (!found) return "none";
  return fmt::format("{}{}", found->is_loss ? "loss of " : "",
                     strategy.contacts[static_cast<std::size_t>(found->contact)].name);
}

TEST(Recognition, NamesTheContactWhoseForceIsFelt) {
  const plan::Strategy strategy = SomeStrategy();
  RandomStream random(1, "recognition");
  for (int round = 0; round < 200; ++round) {
    for (int i = 2; i < 6; ++i) {
      const auto& unwanted = strategy.contacts[static_cast<std::size_t>(i)];
      const Vector6 wrench = ForceOf(strategy.contacts[0], random.Uniform(2, 6), &random) +
                             ForceOf(unwanted, random.Uniform(8, 20), &random);
      EXPECT_EQ(NameOf(strategy, wrench), unwanted.name) << round;
      EXPECT_FALSE(IsAsPlanned(strategy, strategy.motions[0], wrench)) << round;
    }
  }
}

TEST(Recognition, ForcesOfThePlanAreOfNoErrorState) {
  const plan::Strategy strategy = SomeStrategy();
  RandomStream random(2, "recognition");
  for (int round = 0; round < 200; ++round) {
    const Vector6 kept = ForceOf(strategy.contacts[0], random.Uniform(2, 6), &random);
    const Vector6 awaited = ForceOf(strategy.contacts[1], random.Uniform(2, 6), &random);
    EXPECT_EQ(NameOf(strategy, kept), "none");
    EXPECT_EQ(NameOf(strategy, kept + awaited), "none");
    EXPECT_TRUE(IsAsPlanned(strategy, strategy.motions[0], kept + awaited));
  }
}

TEST(Recognition, ForcesOfNoKnownStateAreNotNamed) {
  const plan::Strategy strategy = SomeStrategy();
  const plan::StrategyContact above = {"above", -Vector3::UnitZ(), {0, 0, 0.01}};
  EXPECT_EQ(NameOf(strategy, ForceOf(above, 10, nullptr)), "none");
  EXPECT_EQ(NameOf(strategy, Vector6::Zero()), "none");
  EXPECT_EQ(NameOf(strategy, Vector6::Constant(std::nan(""))), "none");
  EXPECT_EQ(NameOf(strategy, ForceOf(strategy.contacts[2], 0.5, nullptr)), "none")
      << "half a newton tells of nothing";
}

// Two contacts have the same force. The one that smaller errors bring about is named.
TEST(Recognition, OfLikeForcesTheLikelierContactIsNamed) {
  plan::Strategy strategy = SomeStrategy();
  strategy.contacts[4] = strategy.contacts[2];
  strategy.contacts[4].name = "right again";
  strategy.motions[0].unwanted[2].scale = 3;
  const Vector6 wrench = ForceOf(strategy.contacts[2], 10, nullptr);
  EXPECT_EQ(NameOf(strategy, wrench), "right");
  std::swap(strategy.motions[0].unwanted[0].scale, strategy.motions[0].unwanted[2].scale);
  EXPECT_EQ(NameOf(strategy, wrench), "right again");
}

// No contact is planned, so that every force is unplanned.
TEST(Recognition, AfterAFreeMotionAnyForceIsUnplanned) {
  plan::Strategy strategy = SomeStrategy();
  strategy.motions[0].kept.clear();
  strategy.motions[0].until.reset();
  EXPECT_TRUE(IsAsPlanned(strategy, strategy.motions[0], Vector6::Zero()));
  const Vector6 wrench = ForceOf(strategy.contacts[3], 8, nullptr);
  EXPECT_FALSE(IsAsPlanned(strategy, strategy.motions[0], wrench));
  EXPECT_EQ(NameOf(strategy, wrench), "left");
}

}  // namespace
}  // namespace assay::execution::recognition_test
