#include "planner/domain/resting/stable_pose.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/compute_stable_poses.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/rolling.h"
#include "tests/planner/domain/parts.h"
#include "tests/planner/domain/turned_part.h"

namespace assay::domain::stable_pose_test {
namespace {

constexpr std::uint64_t kSeed = 12;

Vector3 Down(const StablePose& pose) { return -pose.X_TablePart.linear().row(2).transpose(); }

const StablePose& Named(const PartModel& part, std::string_view name) {
  const StablePoseId id = part.FindStablePose(name);
  EXPECT_FALSE(id.IsNone()) << name;
  return part.stable_poses()[id.index()];
}

double LowestCorner(const PartModel& part, const Pose& X_TablePart) {
  double lowest = 1e9;
  for (const Vector3& p : part.corners()) lowest = std::min(lowest, (X_TablePart * p).z());
  return lowest;
}

TEST(StablePoseTest, TheBlockRestsOnEachOfItsSixSides) {
  const auto block = LoadPart("block");
  EXPECT_EQ(block->stable_poses().size(), 6u);
  const std::map<std::string, std::vector<int>> hidden = {
      {"face-down", {1, 7, 8}}, {"on-back", {2}}, {"on-other-side", {3}},
      {"on-side", {4}},         {"on-end", {6}},  {"on-other-end", {5}}};
  for (const auto& [name, features] : hidden) {
    EXPECT_EQ(Indices(Named(*block, name).hidden), features) << name;
  }
}

// Spar's peg stands on its base and on its shaft. It has four lying poses, which lean on an edge of
// the plate (1.5 from the axis) and an edge of the tip (0.75 from the axis, 2.75 farther on), in
// inches.
TEST(StablePoseTest, ThePegStandsOnBothEndsAndLeansFourWays) {
  const auto peg = LoadPart("peg");
  ASSERT_EQ(peg->stable_poses().size(), 6u);
  const StablePose& up = Named(*peg, "shaft-up");
  EXPECT_EQ(Indices(up.hidden), (std::vector<int>{1, 8}));
  EXPECT_NEAR(up.X_TablePart.translation().z(), kInch, 1e-9);
  const StablePose& down = Named(*peg, "shaft-down");
  EXPECT_EQ(Indices(down.hidden), std::vector<int>{7});
  EXPECT_NEAR(down.X_TablePart.translation().z(), 2.75 * kInch, 1e-9);
  for (const char* name : {"on-side", "on-other-side", "on-lower-side", "on-upper-side"}) {
    const StablePose& lying = Named(*peg, name);
    EXPECT_TRUE(lying.hidden.empty()) << name;
    EXPECT_NEAR(std::asin(Down(lying).x()), std::atan(0.75 / 2.75), 1e-9) << name;
    EXPECT_NEAR(std::asin(Down(lying).x()) / kDegree, 15.26, 0.005);
  }
}

TEST(StablePoseTest, AKeyChangesOnlyThePoseThatLeansOnIt) {
  const auto peg = LoadPart("keyed-peg");
  ASSERT_EQ(peg->stable_poses().size(), 6u);
  EXPECT_NEAR(std::asin(Down(Named(*peg, "on-upper-side")).x()), std::atan(0.5 / 2.75), 1e-9);
  EXPECT_NEAR(std::asin(Down(Named(*peg, "on-lower-side")).x()), std::atan(0.75 / 2.75), 1e-9);
  EXPECT_EQ(Indices(Named(*peg, "shaft-down").hidden), (std::vector<int>{7, 9}));
  EXPECT_EQ(Indices(Named(*LoadPart("keyed-block"), "face-down").hidden),
            (std::vector<int>{1, 7, 8, 9}));
  EXPECT_EQ(Indices(Named(*LoadPart("twin-block"), "face-down").hidden),
            (std::vector<int>{1, 7, 8, 9, 10}));
}

TEST(StablePoseTest, AnOctagonalPrismRestsOnItsEightSidesAndTwoEnds) {
  const auto part = ParsePart(OctagonalPeg());
  EXPECT_EQ(part->stable_poses().size(), 10u);
  for (const StablePose& pose : part->stable_poses()) {
    EXPECT_EQ(Indices(pose.hidden), std::vector<int>{7});
  }
}

// A part in millimetres whose solids are written as in a part file.
std::shared_ptr<const PartModel> PartOf(const std::string& solids) {
  return ParsePart(
      "format: assay-part/1\nname: part\ninitial: Q\nunits: {length: mm, angle: degree}\n"
      "density: 1000\nfriction: 0.3\nsolids:\n" +
      solids);
}

// The polygon that stands for a circle would rest on each of its sides. A cylinder, a cone and a
// pin with a round head roll away.
TEST(StablePoseTest, RoundPartsRollAndRestOnTheirEndsAlone) {
  const std::string cylinder = "  a: {cylinder: {from: [0, 0, 0], to: [0, 0, 50], radius: 4}}\n";
  const std::string head =
      "  b: {cylinder: {from: [0, 0, -20], to: [0, 0, 0], radius: 30, sides: 48}}\n";
  const std::string cone = "  a: {cone: {from: [0, 0, 0], to: [9, 9, 50], radii: [20, 10]}}\n";
  EXPECT_EQ(PartOf(cylinder)->stable_poses().size(), 2u);
  EXPECT_EQ(PartOf(cylinder + head)->stable_poses().size(), 2u);
  EXPECT_EQ(PartOf(cone)->stable_poses().size(), 2u);
  EXPECT_EQ(LoadPart("dowel")->stable_poses().size(), 2u);
}

// Two rods side by side rest on both, and tip over either of the two lines on which they touch.
TEST(StablePoseTest, TwoRodsBesideEachOtherRestOnTheLinesOnWhichTheyTouch) {
  const auto rods = PartOf(
      "  a: {cylinder: {from: [0, 0, 0], to: [0, 0, 50], radius: 4}}\n"
      "  b: {cylinder: {from: [6, 0, 0], to: [6, 0, 50], radius: 4}}\n");
  ASSERT_EQ(rods->stable_poses().size(), 4u);
  for (const StablePose& pose : rods->stable_poses()) {
    if (std::abs(Down(pose).y()) < 0.5) continue;
    EXPECT_NEAR(pose.tilt_margin, std::atan(3.0 / 4), 1e-6);
    EXPECT_NEAR(geometry::Area(pose.support), 6e-3 * 50e-3, 1e-8);
  }
}

// A rod that is flattened rests on its flat: the flat is a true side.
TEST(StablePoseTest, AFlattenedRodRestsOnItsFlat) {
  const auto rod = PartOf(
      "  a: {cylinder: {from: [0, 0, 0], to: [0, 0, 50], radius: 4}}\n"
      "pockets:\n  flat: {cut_from: a, box: [[-9, -9, -1], [9, -3.5, 51]]}\n");
  ASSERT_EQ(rod->stable_poses().size(), 3u);
  const auto lying = std::ranges::find_if(
      rod->stable_poses(), [](const StablePose& pose) { return Down(pose).y() < -0.5; });
  ASSERT_NE(lying, rod->stable_poses().end());
  EXPECT_GT(geometry::Area(lying->support), 3e-3 * 50e-3);
}

// A plate with a round shaft lies on two corners of the plate and on one point of the shaft's rim.
TEST(StablePoseTest, ARoundPegLeansOnOnePointOfItsRim) {
  const auto peg = LoadPart("round-peg");
  const StablePose& lying = Named(*peg, "on-side");
  EXPECT_EQ(lying.support.size(), 3u);
}

TEST(StablePoseTest, ThePartLiesOnTheTableWithItsCentreOverTheSupport) {
  for (const std::string& name : PartNames()) {
    const auto part = LoadPart(name);
    int number = 0;
    for (const StablePose& pose : part->stable_poses()) {
      EXPECT_EQ(pose.label, part->initial() + "P" + std::to_string(++number));
      EXPECT_EQ(pose.X_TablePart.translation().head<2>(), Vector2(0, 0));
      EXPECT_NEAR(LowestCorner(*part, pose.X_TablePart), 0, 1e-9) << name << " " << pose.label;
      EXPECT_NEAR(pose.X_TablePart.linear().determinant(), 1, 1e-9);
      const Vector3 center = pose.X_TablePart * part->mass().center;
      const double inside = geometry::Depth(pose.support, center.head<2>());
      EXPECT_NEAR(std::tan(pose.tilt_margin), inside / center.z(), 1e-9);
      EXPECT_GE(pose.tilt_margin, 2 * kDegree);
    }
  }
}

// At yaw 0, the first axis of the part that is more than 45 degrees from the vertical points along
// the x axis of the table, seen from above.
TEST(StablePoseTest, YawZeroIsReadOffTheFirstAxisThatLies) {
  for (const std::string& name : PartNames()) {
    const auto part = LoadPart(name);
    for (const StablePose& pose : part->stable_poses()) {
      const geometry::Matrix3 R = pose.X_TablePart.linear();
      int axis = 0;
      while (std::abs(R(2, axis)) > std::sqrt(0.5)) ++axis;
      EXPECT_GT(R(0, axis), 0.7) << name << " " << pose.label;
      EXPECT_NEAR(R(1, axis), 0, 1e-9) << name << " " << pose.label;
    }
  }
}

// Released with any side down, each part rolls into one of the computed poses, and it reaches each
// of them.
TEST(StablePoseTest, RollingEndsInTheComputedPosesAndReachesAll) {
  std::vector<std::shared_ptr<const PartModel>> parts = {ParsePart(OctagonalPeg())};
  for (const std::string& name : PartNames()) parts.push_back(LoadPart(name));
  for (const auto& part : parts) {
    RandomStream random(kSeed, part->name());
    std::vector<int> ended(part->stable_poses().size());
    for (int i = 0; i < 300; ++i) {
      const Vector3 start = oracle::RandomRotation(random).col(0);
      const Vector3 end = oracle::RollToRest(part->corners(), part->mass().center, start, random);
      const auto found = std::ranges::find_if(part->stable_poses(), [&](const StablePose& pose) {
        return (Down(pose) - end).norm() < 0.5 * kDegree;
      });
      ASSERT_NE(found, part->stable_poses().end())
          << part->name() << " ends on " << end.transpose() << ", seed " << kSeed;
      ++ended[static_cast<std::size_t>(found - part->stable_poses().begin())];
    }
    EXPECT_GT(*std::ranges::min_element(ended), 0) << part->name() << ", seed " << kSeed;
  }
}

TEST(StablePoseTest, AStricterLeastTiltKeepsTheSteadierPoses) {
  const auto peg = LoadPart("peg");
  for (double degrees : {0.0, 10.0, 20.0, 30.0, 60.0}) {
    const auto steadier = [&](const StablePose& p) { return p.tilt_margin >= degrees * kDegree; };
    EXPECT_EQ(ComputeStablePoses(*peg, degrees * kDegree).size(),
              static_cast<std::size_t>(std::ranges::count_if(peg->stable_poses(), steadier)));
  }
}

// A part that is written in another frame has the same poses.
TEST(StablePoseTest, MovingThePartInItsFilePermutesItsPoses) {
  const auto part = ParsePart(MovedPeg(Pose::Identity()));
  ASSERT_GE(part->stable_poses().size(), 5u);
  RandomStream random(kSeed, "moved");
  for (int trial = 0; trial < 12; ++trial) {
    Pose X_NewOld = geometry::Translation(oracle::RandomVector(random, 50));  // mm, like the file
    X_NewOld.linear() = oracle::RandomQuarterTurns(random);
    const auto moved = ParsePart(MovedPeg(X_NewOld));
    ASSERT_EQ(moved->stable_poses().size(), part->stable_poses().size());
    for (const StablePose& pose : part->stable_poses()) {
      const Vector3 down = X_NewOld.linear() * Down(pose);
      const auto same = std::ranges::find_if(moved->stable_poses(), [&](const StablePose& p) {
        return (Down(p) - down).norm() < 1e-6;
      });
      ASSERT_NE(same, moved->stable_poses().end()) << "seed " << kSeed << " trial " << trial;
      EXPECT_EQ(same->hidden, pose.hidden);
      EXPECT_NEAR(same->tilt_margin, pose.tilt_margin, 1e-7);
      EXPECT_NEAR(geometry::Area(same->support), geometry::Area(pose.support), 1e-9);
    }
  }
}

}  // namespace
}  // namespace assay::domain::stable_pose_test
