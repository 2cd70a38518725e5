#include "planner/finemotion/forces/force_signature.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "planner/base/random.h"

namespace assay::finemotion::force_signature_test {
namespace {

constexpr double kLength = 0.02;  // m

PrimitiveContact ContactAt(const Vector3& at, const Vector3& normal) {
  PrimitiveContact contact;
  contact.normal = normal.normalized();
  contact.at = at;
  return contact;
}

Wrench ForceAt(const Vector3& at, const Vector3& force) {
  Wrench wrench;
  wrench << force, at.cross(force);
  return wrench;
}

Vector3 RandomVector(RandomStream& random) {
  return {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
}

// Returns a random force that a contact can exert with Coulomb friction.
Vector3 ForceOf(const PrimitiveContact& contact, double friction, RandomStream& random) {
  const Vector3 sideways = contact.normal.cross(RandomVector(random)).normalized();
  const double pressure = random.Uniform(0, 1);
  return pressure * (contact.normal + friction * std::sqrt(random.Uniform()) * sideways);
}

TEST(ForceSignature, HoldsWhateverTheFrictionConesAllow) {
  RandomStream random(2, "signature");
  for (int round = 0; round < 2000; ++round) {
    const double friction = random.Uniform(0, 0.6);
    std::vector<PrimitiveContact> contacts;
    Wrench wrench = Wrench::Zero();
    for (int i = 0; i <= random.Index(3); ++i) {
      contacts.push_back(ContactAt(0.03 * RandomVector(random), RandomVector(random)));
      wrench += ForceAt(contacts.back().at, ForceOf(contacts.back(), friction, random));
    }
    EXPECT_LT(Separation(wrench, SignatureOf(contacts, friction), kLength), 1e-8);
  }
}

TEST(ForceSignature, WithoutFrictionIsTheNormalsWrench) {
  const PrimitiveContact contact = ContactAt({0.01, 0.02, -0.03}, {1, 2, 3});
  const ForceSignature signature = SignatureOf({contact}, 0);
  ASSERT_EQ(signature.rays.cols(), 1);
  EXPECT_LT((signature.rays.col(0) - ForceAt(contact.at, contact.normal)).norm(), 1e-15);
}

// Torques are divided by the length. A force of 1 N and a torque of 1 N m / length are at 45
// degrees.
TEST(ForceSignature, SeparationOfSingleRaysIsTheSineOfTheirAngle) {
  const ForceSignature force = SignatureOf({ContactAt(Vector3::Zero(), Vector3::UnitZ())}, 0);
  const ForceSignature both =
      SignatureOf({ContactAt({kLength, 0, 0}, Vector3::UnitZ())}, 0);  // adds a torque about -y
  EXPECT_NEAR(Separation(force, both, kLength), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(Separation(ForceAt(Vector3::Zero(), Vector3::UnitZ()), both, kLength), std::sqrt(0.5),
              1e-9);
  EXPECT_NEAR(Separation(ForceAt(Vector3::Zero(), -Vector3::UnitZ()), force, kLength), 1, 1e-12);
  EXPECT_EQ(Separation(force, SignatureOf(std::vector<PrimitiveContact>{}, 0.2), kLength), 1);
}

// No wrench of one signature makes a smaller angle with a wrench of the other.
TEST(ForceSignature, SeparationIsALowerBoundOfAllAngles) {
  RandomStream random(3, "separation");
  for (int round = 0; round < 300; ++round) {
    std::vector<PrimitiveContact> a;
    std::vector<PrimitiveContact> b;
    for (int i = 0; i < 2; ++i) {
      a.push_back(ContactAt(0.03 * RandomVector(random), RandomVector(random)));
      b.push_back(ContactAt(0.03 * RandomVector(random), RandomVector(random)));
    }
    const double friction = 0.2;
    const double separation =
        Separation(SignatureOf(a, friction), SignatureOf(b, friction), kLength);
    EXPECT_NEAR(separation, Separation(SignatureOf(b, friction), SignatureOf(a, friction), kLength),
                1e-9);
    for (int sample = 0; sample < 30; ++sample) {
      Wrench of_a = Wrench::Zero();
      for (const PrimitiveContact& contact : a) {
        of_a += ForceAt(contact.at, ForceOf(contact, friction, random));
      }
      EXPECT_GE(Separation(of_a, SignatureOf(b, friction), kLength), separation - 1e-9);
    }
  }
}

TEST(ForceSignature, OfASubsetIsNotSeparate) {
  const PrimitiveContact one = ContactAt({0.01, 0, 0}, {0, 0, 1});
  const PrimitiveContact other = ContactAt({-0.01, 0, 0.01}, {1, 0, 0});
  EXPECT_NEAR(Separation(SignatureOf({one}, 0.2), SignatureOf({one, other}, 0.2), kLength), 0,
              1e-7);
}

// Returns a random wrench of contacts, each of which exerts a force.
Wrench WrenchOf(const std::vector<PrimitiveContact>& contacts, double friction,
                RandomStream& random) {
  Wrench wrench = Wrench::Zero();
  for (const PrimitiveContact& contact : contacts) {
    wrench += ForceAt(contact.at, ForceOf(contact, friction, random));
  }
  return wrench;
}

double SineBetween(Wrench a, Wrench b) {
  a.tail<3>() /= kLength;
  b.tail<3>() /= kLength;
  const double cosine = a.dot(b) / (a.norm() * b.norm());
  return cosine > 0 ? std::sqrt(std::max(0.0, 1 - cosine * cosine)) : 1;
}

// Oracle: wrenches of both cones are drawn at random and moved at random towards each other. They
// never come nearer than the stated separation, and they reach it.
TEST(ForceSignature, SeparationIsWhatSampledWrenchesComeTo) {
  RandomStream random(7, "sampled separation");
  for (int round = 0; round < 6; ++round) {
    const PrimitiveContact a = ContactAt(0.02 * RandomVector(random), RandomVector(random));
    const PrimitiveContact b = ContactAt(0.02 * RandomVector(random), RandomVector(random));
    const double friction = 0.2;
    const double told =
        Separation(SignatureOf({a}, friction, 32), SignatureOf({b}, friction, 32), kLength);
    double nearest = 1;
    for (int sample = 0; sample < 20'000; ++sample) {
      nearest = std::min(
          nearest, SineBetween(WrenchOf({a}, friction, random), WrenchOf({b}, friction, random)));
    }
    EXPECT_GE(nearest, told - 1e-9);
    EXPECT_LT(nearest, told + 0.1);
  }
}

// Contacts that both states have do not distinguish them. Contacts that only one state has do. The
// separation is the least distance of the wrenches of these contacts from all wrenches of the other
// state.
TEST(ForceSignature, StatesAreApartByWhatIsNotInBoth) {
  RandomStream random(8, "states");
  const double friction = 0.2;
  for (int round = 0; round < 20; ++round) {
    const PrimitiveContact kept = ContactAt(0.02 * RandomVector(random), RandomVector(random));
    const PrimitiveContact one = ContactAt(0.02 * RandomVector(random), RandomVector(random));
    const PrimitiveContact other = ContactAt(0.02 * RandomVector(random), RandomVector(random));
    const auto signature = [&](const std::vector<PrimitiveContact>& contacts) {
      return SignatureOf(contacts, friction);
    };
    const double told =
        SeparationOfStates(signature({kept}), signature({one}), signature({other}), kLength);
    EXPECT_NEAR(
        told, SeparationOfStates(signature({kept}), signature({other}), signature({one}), kLength),
        1e-9);
    for (int sample = 0; sample < 200; ++sample) {
      EXPECT_GE(Separation(WrenchOf({one}, friction, random), signature({kept, other}), kLength),
                told - 1e-9);
      EXPECT_GE(Separation(WrenchOf({other}, friction, random), signature({kept, one}), kLength),
                told - 1e-9);
    }
  }
}

TEST(ForceSignature, StatesOfTheSameForcesAreNotApart) {
  const auto up = SignatureOf({ContactAt({0.01, 0, 0}, Vector3::UnitZ())}, 0);
  const auto beside = SignatureOf({ContactAt({-0.01, 0, 0}, Vector3::UnitZ())}, 0);
  const auto between = SignatureOf({ContactAt({0, 0, 0}, Vector3::UnitZ())}, 0);
  const auto none = SignatureOf(std::vector<PrimitiveContact>{}, 0);
  EXPECT_NEAR(SeparationOfStates(up, beside, between, kLength), 0, 1e-7)
      << "a force between two contacts may be of both";
  EXPECT_NEAR(SeparationOfStates(up, up, none, kLength), 0, 1e-7);
  EXPECT_EQ(SeparationOfStates(none, up, none, kLength), 1);
  EXPECT_EQ(SeparationOfStates(up, none, none, kLength), 1);
}

// A part on a table sticks if the push through the contact point is steeper than the friction angle
// from the table. Otherwise it slides.
TEST(ForceSignature, JamsInsideTheFrictionCone) {
  const double friction = 0.3;
  const Vector3 at(0.01, -0.02, -0.03);
  const ForceSignature signature = SignatureOf({ContactAt(at, Vector3::UnitZ())}, friction, 64);
  for (const double turn : {0.0, 1.0, 2.5, 4.0}) {
    for (const double angle : {0.0, 0.5, 0.99, 1.01, 1.5}) {
      const double lean = angle * std::atan(friction);
      const Vector3 push(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn),
                         -std::cos(lean));
      EXPECT_EQ(Jams(signature, ForceAt(at, push), kLength), angle < 1) << angle << " " << turn;
      // The same force beside the contact tips the part over.
      EXPECT_FALSE(Jams(signature, ForceAt(at + Vector3(0.001, 0, 0), push), kLength));
    }
  }
}

// A peg in a hole in two-point contact wedges if the points are in each other's friction cones
// (Nevins and Whitney 1978), which means that depth / width is below the friction.
TEST(ForceSignature, WedgesWhereContactsAreInEachOthersCones) {
  const double width = 0.02;
  for (const double friction : {0.1, 0.2, 0.5}) {
    for (const double part : {0.2, 0.9, 0.99, 1.01, 1.1, 3.0}) {
      const double depth = part * friction * width;
      const ForceSignature two = SignatureOf({ContactAt({-width / 2, 0, 0}, Vector3::UnitX()),
                                              ContactAt({width / 2, 0, depth}, -Vector3::UnitX())},
                                             friction, 64);
      EXPECT_EQ(Wedges(two, kLength), part < 1) << friction << " " << part;
    }
  }
  EXPECT_FALSE(Wedges(SignatureOf({ContactAt(Vector3::Zero(), Vector3::UnitZ())}, 0.5), kLength));
  EXPECT_FALSE(Wedges(SignatureOf(std::vector<PrimitiveContact>{}, 0.5), kLength));
}

}  // namespace
}  // namespace assay::finemotion::force_signature_test
