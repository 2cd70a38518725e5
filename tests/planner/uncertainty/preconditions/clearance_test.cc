#include "planner/uncertainty/preconditions/clearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/box_pair.h"
#include "tests/planner/uncertainty/action_lists.h"

namespace assay::uncertainty::clearance_test {
namespace {

using geometry::Box;

Vector3 AnyVector(RandomStream& random, double most) {
  return {random.Uniform(-most, most), random.Uniform(-most, most), random.Uniform(-most, most)};
}

Pose AnyPose(RandomStream& random, double most) {
  Pose pose = geometry::Translation(0, 0, 0);
  pose.linear() =
      Eigen::AngleAxisd(random.Uniform(-3, 3), AnyVector(random, 1).normalized()).matrix();
  pose.translation() = AnyVector(random, most);
  return pose;
}

// A box that moves along a straight way. Errors within bounds displace its frame and turn it about
// the world's z axis.
struct Thing {
  Box box;
  Pose planned;
  double length = 0;  // greatest error along each axis, metres
  double angle = 0;
  Vector3 way = Vector3::Zero();

  Box At(const Vector3& d, double turn, double share) const {
    Pose pose = planned;
    pose.linear() = geometry::RotationZ(turn).linear() * planned.linear();
    pose.translation() += d + share * way;
    return box.Transformed(pose);
  }
  Box AtAnyCorner(RandomStream& random) const {
    const auto sign = [&] { return random.Index(2) == 0 ? -1.0 : 1.0; };
    const Vector3 d = length * Vector3(sign(), sign(), sign());
    const double turn = random.Index(4) == 0 ? random.Uniform(-angle, angle) : sign() * angle;
    return At(d, turn, random.Index(3) / 2.0);
  }
  PossibleFrame Frame(UncertainWorld& world) const {
    const auto declare = [&](double most) {
      return world.Declare(plan::error::kX, {-most, most}, PartId::None());
    };
    const RestingError error = {{declare(length), declare(length), declare(length)},
                                declare(angle)};
    return {planned, PossiblePose(planned, error), angle};
  }
};

Thing AnyThing(RandomStream& random, bool goes) {
  return {
      .box = {AnyPose(random, 0.05), AnyVector(random, 0.04).cwiseAbs() + Vector3::Constant(0.005)},
      .planned = AnyPose(random, 0.1),
      .length = random.Index(3) == 0 ? 0 : random.Uniform(0, 0.01),
      .angle = random.Index(3) == 0 ? 0 : random.Uniform(0, 0.1),
      .way = goes ? AnyVector(random, 0.1) : Vector3::Zero()};
}

struct Asked {
  bool proved = true;
  int conditions = 0;
  double margin = 0;  // the least margin of all preconditions
};

Asked Ask(const Thing& a, const Thing& b, const Vector3& slack) {
  static const domain::Problem problem = LoadScenario("uncertain-known");
  UncertainWorld world(problem, Propagation::kSound);
  const PossibleFrame frame_a = a.Frame(world);
  const PossibleFrame frame_b = b.Frame(world);
  Preconditions conditions;
  RequireApart(Body(frame_a, HullOf(a.box), WayOf(world, a.way, 0)),
               Body(frame_b, HullOf(b.box), WayOf(world, b.way, 0)),
               {{plan::condition::kHandClear, "one stays clear of the other"},
                DisplacementBetween(world, frame_a, frame_b),
                slack},
               conditions);
  Asked asked = {.margin = std::numeric_limits<double>::infinity()};
  for (const Precondition& condition : conditions.Take()) {
    const double margin = condition.limit - world.TightRangeOf(condition.expression).high;
    asked.margin = std::min(asked.margin, margin);
    ++asked.conditions;
  }
  asked.proved = asked.margin > 0;
  return asked;
}

// Boxes never meet if their clearance is proved or needs no precondition. Many of the boxes that
// never meet are proved.
TEST(Clearance, WhatIsProvedNeverMeets) {
  RandomStream random(27, "clearance");
  int apart = 0;
  int proved = 0;
  int asked_of_proved = 0;
  for (int i = 0; i < 400; ++i) {
    const Thing a = AnyThing(random, random.Index(2) == 0);
    const Thing b = AnyThing(random, false);
    const Asked asked = Ask(a, b, Vector3::Zero());
    double least = std::numeric_limits<double>::infinity();
    for (int draw = 0; draw < 200; ++draw) {
      const Box of_a = a.AtAnyCorner(random);
      const Box of_b = b.AtAnyCorner(random);
      least = std::min(least, oracle::Separation(of_a, of_b));
    }
    if (asked.proved) {
      EXPECT_GT(least, 0) << "pair " << i;
      ++proved;
      asked_of_proved += asked.conditions > 0 ? 1 : 0;
    }
    if (least > 0.005) ++apart;
  }
  EXPECT_GT(proved, apart / 2) << "of " << apart << " that stay well apart";
  EXPECT_GT(asked_of_proved, 5);
}

// Two cubes stand side by side. One of them may come nearer by the error and by the slack.
TEST(Clearance, MarginIsTheGapLessErrorsAndSlack) {
  const Box cube = {Pose::Identity(), Vector3::Constant(0.01)};
  const Thing here = {.box = cube, .planned = Pose::Identity(), .way = {0, 0, 0.3}};
  for (const double error : {0.001, 0.0019, 0.003}) {
    const Thing there = {
        .box = cube, .planned = geometry::Translation(0.022, 0, 0.2), .length = error};
    for (const double slack : {0.0, 0.0005}) {
      const Asked asked = Ask(here, there, Vector3::Constant(slack));
      const double room = 0.002 - error - slack;
      if (room > 0) {
        EXPECT_EQ(asked.conditions, 0) << error;
      } else {
        EXPECT_NEAR(asked.margin, room, 1e-9) << error;
      }
    }
  }
}

// Two crossing bars are separated only by a plane along an edge of each, which contains no side of
// a box.
TEST(Clearance, EdgesKeepCrossingBarsApart) {
  Pose first = Pose::Identity();
  first.linear() = (Eigen::AngleAxisd(0.5, Vector3::UnitY()) *
                    Eigen::AngleAxisd(std::atan(1.0), Vector3::UnitX()))
                       .matrix();
  Pose second = Pose::Identity();
  second.linear() =
      (Eigen::AngleAxisd(1.0, Vector3::UnitZ()) * Eigen::AngleAxisd(0.5, Vector3::UnitY()) *
       Eigen::AngleAxisd(std::atan(1.0), Vector3::UnitX()))
          .matrix();
  const Box bar = {Pose::Identity(), Vector3(0.1, 0.005, 0.005)};
  const Thing below = {.box = bar, .planned = first};
  for (const double height : {0.012, 0.016, 0.02, 0.03}) {
    const Thing above = {.box = bar, .planned = geometry::Translation(0, 0, height) * second};
    const double separation =
        oracle::Separation(below.box.Transformed(first), bar.Transformed(above.planned));
    const Asked asked = Ask(below, above, Vector3::Zero());
    EXPECT_EQ(asked.proved, separation > 0) << height;
  }
}

}  // namespace
}  // namespace assay::uncertainty::clearance_test
