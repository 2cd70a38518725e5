#include "planner/domain/grasps/grasp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/geometry/solids/separation.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/domain/parts.h"
#include "tests/planner/domain/scenario.h"
#include "tests/planner/domain/turned_part.h"

namespace assay::domain::grasp_test {
namespace {

using geometry::Box;

constexpr std::uint64_t kSeed = 44;
constexpr double kAllowance = 1e-4;
constexpr GraspSearch kSearch{.approach_step = 15 * kDegree, .widest = 4 * kInch};

std::vector<Grasp> GraspsOf(const PartModel& part, const GraspSearch& search = kSearch) {
  return ComputeGrasps(part, ParallelJaw(), search);
}

std::vector<std::shared_ptr<const PartModel>> AllParts() {
  std::vector<std::shared_ptr<const PartModel>> parts = {ParsePart(OctagonalPeg())};
  for (const std::string& name : PartNames()) parts.push_back(LoadPart(name));
  return parts;
}

Vector3 ApproachOf(const Grasp& grasp) { return grasp.X_PartTool.linear().col(2); }
Vector3 ClosingOf(const Grasp& grasp) { return grasp.X_PartTool.linear().col(1); }

bool IsSolid(const PartModel& part, const Vector3& p) {
  return std::ranges::any_of(part.pieces(),
                             [&](const auto& piece) { return Contains(piece, p, 0); });
}

bool IsAcross(const Grasp& grasp, int axis) { return std::abs(ClosingOf(grasp)[axis]) > 0.99; }

bool Hides(const Grasp& grasp, int feature) {
  return std::ranges::find(grasp.hidden, FeatureNumber(feature)) != grasp.hidden.end();
}

// Returns points all over a pad, at the distance `above` from the surface of the part (metres).
// `side` is +1 or -1.
std::vector<Vector3> PadPoints(const Grasp& grasp, int side, double above) {
  const Vector2 half = ParallelJaw().pad_half_extents();
  std::vector<Vector3> points;
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      points.push_back(grasp.X_PartTool * Vector3(0.2499 * i * half.x(),
                                                  side * (grasp.width / 2 + above),
                                                  0.2499 * j * half.y()));
    }
  }
  return points;
}

TEST(GraspTest, TheBlockIsTakenAcrossXOrYButNeverZ) {
  const auto block = LoadPart("block");
  const auto grasps = GraspsOf(*block);
  const auto count = [&](int axis) {
    return std::ranges::count_if(grasps, [&](const Grasp& g) { return IsAcross(g, axis); });
  };
  EXPECT_EQ(count(0), 24);
  EXPECT_EQ(count(1), 24);
  EXPECT_EQ(count(2), 0);
  for (const Grasp& grasp : grasps) {
    EXPECT_NEAR(grasp.width, 3 * kInch, 1e-9);
    EXPECT_EQ(Indices(grasp.hidden),
              IsAcross(grasp, 0) ? (std::vector<int>{1, 2}) : (std::vector<int>{3, 4}));
  }
}

TEST(GraspTest, WiderGraspsAreFoundWhenAskedFor) {
  const auto block = LoadPart("block");
  const auto wide = GraspsOf(*block, {.approach_step = 15 * kDegree, .widest = 0.2});
  EXPECT_EQ(std::ranges::count_if(wide, [](const Grasp& g) { return IsAcross(g, 2); }), 24);
  for (const Grasp& grasp : wide) {
    if (IsAcross(grasp, 2)) {
      EXPECT_NEAR(grasp.width, 6.5 * kInch, 1e-9);
    }
  }
  EXPECT_TRUE(GraspsOf(*block, {.approach_step = 15 * kDegree, .widest = 2.9 * kInch}).empty());
}

// The approach is from +x along the shaft, or up to 75 degrees away from it. The mating features
// stay free.
TEST(GraspTest, ThePegIsTakenAcrossItsPlateForInsertion) {
  const auto peg = LoadPart("peg");
  const auto grasps = GraspsOf(*peg);
  for (int across : {1, 2}) {
    for (int step = -5; step <= 5; ++step) {
      const double angle = step * 15 * kDegree;
      Vector3 wanted = Vector3(std::cos(angle), 0, 0);
      wanted[3 - across] = std::sin(angle);
      const auto fits = [&](const Grasp& g) {
        return IsAcross(g, across) && (ApproachOf(g) - wanted).norm() < 1e-6 && !Hides(g, 7) &&
               !Hides(g, 8) && std::abs(g.width - 3 * kInch) < 1e-9;
      };
      EXPECT_EQ(std::ranges::count_if(grasps, fits), 1) << across << " at " << step * 15;
    }
  }
}

// Faces 9 mm wide have room for pads of 8 mm that are straight. Turned by 30 degrees, the pads need
// 8 (cos 30 + sin 30) = 10.9 mm, and stick out.
TEST(GraspTest, TurnedPadsStickOutOfFacesThatHaveRoomForStraightOnes) {
  const Problem problem = LoadScenario("key-bar");
  const auto approaches = [&](double degrees) {
    return std::ranges::any_of(
        *problem.part(PartNamed(problem, "bar")).grasps, [&](const Grasp& grasp) {
          const double lean = -ApproachOf(grasp).z();
          return IsAcross(grasp, 0) && std::abs(lean - std::cos(degrees * kDegree)) < 1e-6;
        });
  };
  EXPECT_TRUE(approaches(0));
  EXPECT_TRUE(approaches(30));
  EXPECT_TRUE(approaches(60));
}

TEST(GraspTest, HandsOnTheShaftHideIt) {
  for (const Grasp& grasp : GraspsOf(*LoadPart("peg"))) {
    if (std::abs(grasp.width - 1.5 * kInch) < 1e-9) {
      EXPECT_EQ(Indices(grasp.hidden), std::vector<int>{7});
    }
  }
}

// A peg that is only a shaft can be held so that all but its end is free. The pads keep 4 mm from
// the end.
TEST(GraspTest, APegThatIsOnlyAShaftIsAlsoHeldAtItsEnd) {
  for (const std::string shape : {"box: [[-10, -10, 0], [10, 10, 100]]",
                                  "cylinder: {from: [0, 0, 0], to: [0, 0, 100], radius: 8}"}) {
    const auto peg = ParsePart(
        "format: assay-part/1\nname: peg\ninitial: P\nunits: {length: mm, angle: degree}\n"
        "density: 1000\nfriction: 0.3\nsolids:\n  peg: {" +
        shape +
        "}\n"
        "features:\n  1: {shaft: peg, axis: -z, what: shaft}\n");
    const double highest = 0.1 - 0.004 - ParallelJaw().pad_half_extents().y();
    int at_end = 0;
    for (const Grasp& grasp : GraspsOf(*peg)) {
      EXPECT_LE(grasp.X_PartTool.translation().z(), highest + 1e-6) << grasp.label;
      const bool from_above = ApproachOf(grasp).z() < -1 + 1e-9;
      at_end += from_above && grasp.X_PartTool.translation().z() > highest - 1e-6;
    }
    EXPECT_GT(at_end, 0) << shape;
  }
}

TEST(GraspTest, ABrickIsTakenAcrossXAndYFromEverywhere) {
  EXPECT_EQ(GraspsOf(*LoadPart("brick")).size(), 3u * 24u);
}

// Returns whether two grasps are of the same class, and less than a millimetre apart: same faces,
// approach and hidden features. A half turn of the tool about its z axis does not matter.
bool SameClass(const Grasp& a, const Grasp& b) {
  const Vector3 apart = a.X_PartTool.translation() - b.X_PartTool.translation();
  return (ApproachOf(a) - ApproachOf(b)).norm() < 1e-6 &&
         ClosingOf(a).cross(ClosingOf(b)).norm() < 1e-6 && apart.norm() < 0.999e-3 &&
         std::abs(a.width - b.width) < 1e-6 && a.hidden == b.hidden;
}

TEST(GraspTest, LabelsAreCountedAndClassesDistinct) {
  for (const auto& part : AllParts()) {
    const std::vector<Grasp> grasps = GraspsOf(*part);
    EXPECT_FALSE(grasps.empty()) << part->name();
    for (std::size_t i = 0; i < grasps.size(); ++i) {
      EXPECT_EQ(grasps[i].label, part->initial() + "G" + std::to_string(i + 1));
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(SameClass(grasps[i], grasps[j]))
            << part->name() << " " << grasps[i].label << " " << grasps[j].label;
      }
    }
  }
}

// Returns how many of a pad's points have material just inside the face.
long PointsOnMaterial(const PartModel& part, const Grasp& grasp, int side) {
  return std::ranges::count_if(PadPoints(grasp, side, -1e-5),
                               [&](const Vector3& p) { return IsSolid(part, p); });
}

// Under every point of a pad there is material just inside the face and none just outside. Faces
// that are too narrow for that come last (narrow_grasp_test.cc), and the pads touch them, too.
TEST(GraspTest, PadsLieWhollyOnTheSurface) {
  constexpr long kPoints = 81;
  for (const auto& part : AllParts()) {
    bool narrow = false;
    for (const Grasp& grasp : GraspsOf(*part)) {
      narrow |= PointsOnMaterial(*part, grasp, 1) < kPoints;
      for (int side : {-1, 1}) {
        const long touched = PointsOnMaterial(*part, grasp, side);
        ASSERT_GE(touched, narrow ? 1 : kPoints) << part->name() << " " << grasp.label;
        for (const Vector3& p : PadPoints(grasp, side, 1e-5)) {
          ASSERT_FALSE(IsSolid(*part, p)) << part->name() << " " << grasp.label;
        }
      }
    }
  }
}

// Returns the features that contain a sampled point of a pad.
std::set<FeatureNumber> SampledHidden(const PartModel& part, const Grasp& grasp) {
  std::set<FeatureNumber> hidden;
  for (int side : {-1, 1}) {
    for (const Vector3& p : PadPoints(grasp, side, 0)) {
      for (const Feature& feature : part.features()) {
        const auto holds = [&](FaceId id, const std::vector<geometry::Polygon>& patches) {
          const Face& face = part.faces()[id.index()];
          const Vector3 seen = face.X_PartFace.inverse() * p;
          const bool towards = face.normal.dot(side * ClosingOf(grasp)) > 0.999;
          return towards && std::abs(seen.z()) < 1e-6 &&
                 std::ranges::any_of(patches, [&](const geometry::Polygon& patch) {
                   return geometry::Depth(patch, seen.head<2>()) >= 0;
                 });
        };
        for (FaceId face : feature.faces) {
          if (holds(face, part.faces()[face.index()].patches)) hidden.insert(feature.number);
        }
        for (const Mouth& mouth : feature.mouths) {
          if (holds(mouth.face, {mouth.outline})) hidden.insert(feature.number);
        }
      }
    }
  }
  return hidden;
}

TEST(GraspTest, HiddenFeaturesAreThoseUnderSampledPoints) {
  for (const auto& part : AllParts()) {
    for (const Grasp& grasp : GraspsOf(*part)) {
      const std::set<FeatureNumber> sampled = SampledHidden(*part, grasp);
      EXPECT_EQ(grasp.hidden, std::vector<FeatureNumber>(sampled.begin(), sampled.end()))
          << part->name() << " " << grasp.label;
    }
  }
}

bool Collides(const PartModel& part, const std::vector<Box>& gripper, const Pose& X_PartTool) {
  for (const Box& box : gripper) {
    for (const geometry::ConvexHull& other : part.pieces()) {
      if (geometry::Separation(HullOf(box.Transformed(X_PartTool)), other) < -2 * kAllowance)
        return true;
    }
  }
  return false;
}

// The fingers are free when open, at the grasp and all along the way out, and when closed at the
// grasp.
TEST(GraspTest, HandAndFingersAreFreeOfThePart) {
  const kinematics::Gripper& gripper = ParallelJaw();
  std::vector<Box> opened = gripper.FingerBoxes(gripper.max_opening());
  opened.insert(opened.end(), gripper.HandBoxes().begin(), gripper.HandBoxes().end());
  for (const auto& part : AllParts()) {
    for (const Grasp& grasp : GraspsOf(*part)) {
      ASSERT_LE(grasp.width, gripper.max_opening());
      EXPECT_FALSE(Collides(*part, gripper.FingerBoxes(grasp.width), grasp.X_PartTool))
          << part->name() << " " << grasp.label;
      for (double back : {0.0, 0.01, 0.03, 0.06, 0.1}) {
        EXPECT_FALSE(Collides(*part, opened, grasp.X_PartTool * geometry::Translation(0, 0, -back)))
            << part->name() << " " << grasp.label << " " << back;
      }
    }
  }
}

// Properties that do not depend on how ties are broken: the pair of faces, the direction, and the
// distance of the best grasp of the class from the centre of mass.
struct Invariants {
  Vector3 approach;
  Vector3 closing;
  double width;
  double from_mass;
  double along_closing;  // distance of the tool's origin from the centre of mass, up to sign
  std::vector<FeatureNumber> hidden;
};

Invariants InvariantsOf(const PartModel& part, const Grasp& grasp) {
  const Vector3 p = grasp.X_PartTool.inverse() * part.mass().center;
  return {ApproachOf(grasp), ClosingOf(grasp), grasp.width, Vector2(p.x(), p.z()).norm(),
          std::abs(p.y()),   grasp.hidden};
}

bool Same(const Invariants& a, const Invariants& b) {
  const bool parallel =
      (a.closing - b.closing).norm() < 1e-6 || (a.closing + b.closing).norm() < 1e-6;
  return parallel && (a.approach - b.approach).norm() < 1e-6 && a.hidden == b.hidden &&
         std::abs(a.width - b.width) < 1e-6 && std::abs(a.from_mass - b.from_mass) < 1e-5 &&
         std::abs(a.along_closing - b.along_closing) < 1e-6;
}

TEST(GraspTest, MovingThePartInItsFilePermutesItsGrasps) {
  const auto part = ParsePart(MovedPeg(Pose::Identity()));
  const auto grasps = GraspsOf(*part);
  ASSERT_GT(grasps.size(), 24u);
  RandomStream random(kSeed, "moved");
  for (int trial = 0; trial < 12; ++trial) {
    Pose X_NewOld = geometry::Translation(oracle::RandomVector(random, 50));  // mm, like the file
    X_NewOld.linear() = oracle::RandomQuarterTurns(random);
    const auto moved = ParsePart(MovedPeg(X_NewOld));
    const auto moved_grasps = GraspsOf(*moved);
    ASSERT_EQ(moved_grasps.size(), grasps.size()) << "seed " << kSeed << " trial " << trial;
    for (const Grasp& grasp : grasps) {
      Invariants expected = InvariantsOf(*part, grasp);
      expected.approach = X_NewOld.linear() * expected.approach;
      expected.closing = X_NewOld.linear() * expected.closing;
      EXPECT_TRUE(std::ranges::any_of(
          moved_grasps, [&](const Grasp& g) { return Same(InvariantsOf(*moved, g), expected); }))
          << grasp.label << ", seed " << kSeed << " trial " << trial;
    }
  }
}

// With a coarser step the directions are a subset, and their grasps are equal.
TEST(GraspTest, ACoarserStepKeepsEverySecondDirection) {
  for (const auto& part : AllParts()) {
    const auto fine = GraspsOf(*part);
    for (const Grasp& grasp :
         GraspsOf(*part, {.approach_step = 30 * kDegree, .widest = 4 * kInch})) {
      EXPECT_TRUE(std::ranges::any_of(fine,
                                      [&](const Grasp& g) {
                                        return g.X_PartTool.isApprox(grasp.X_PartTool, 1e-9) &&
                                               g.hidden == grasp.hidden;
                                      }))
          << part->name() << " " << grasp.label;
    }
  }
}

TEST(GraspTest, IsDeterministic) {
  const auto peg = LoadPart("peg");
  const auto once = GraspsOf(*peg), again = GraspsOf(*LoadPart("peg"));
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].X_PartTool.matrix(), again[i].X_PartTool.matrix());
  }
}

}  // namespace
}  // namespace assay::domain::grasp_test
