#include "planner/domain/parts/part_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/parts/part_file.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/domain/parts.h"

namespace assay::domain::part_model_test {
namespace {

using geometry::Polygon;

constexpr std::uint64_t kSeed = 3;
constexpr double kCubicInch = kInch * kInch * kInch;
constexpr double kSquareInch = kInch * kInch;

double SurfaceOf(const PartModel& part) {
  double area = 0;
  for (const Face& face : part.faces()) area += geometry::Area(face.patches);
  return area;
}

// Expects a closed surface by the divergence theorem: the area-weighted normals add up to zero, and
// a third of offset times area adds up to the enclosed volume.
void ExpectClosedSurface(const PartModel& part, double volume, double tolerance) {
  Vector3 normals = Vector3::Zero();
  double enclosed = 0;
  for (const Face& face : part.faces()) {
    const double area = geometry::Area(face.patches);
    normals += area * face.normal;
    enclosed += area * face.offset / 3;
  }
  EXPECT_LT(normals.norm(), 1e-9) << part.name();
  EXPECT_NEAR(enclosed, volume, tolerance) << part.name();
}

bool IsSolid(const PartModel& part, const Vector3& p) {
  return std::ranges::any_of(part.pieces(),
                             [&](const auto& piece) { return Contains(piece, p, 0); });
}

FaceId FaceAt(const PartModel& part, const Vector3& normal, double offset) {
  const FaceId id = FindFace(part.faces(), normal, offset);
  EXPECT_FALSE(id.IsNone());
  return id;
}

// Returns a square on a face around a point of the part frame.
Polygon SquareAround(const Face& face, const Vector3& center, double half) {
  const Vector2 c = (face.X_PartFace.inverse() * center).head<2>();
  return {c + Vector2(-half, -half), c + Vector2(half, -half), c + Vector2(half, half),
          c + Vector2(-half, half)};
}

void ExpectSameGeometry(const PartModel& a, const PartModel& b) {
  ASSERT_EQ(a.pieces().size(), b.pieces().size());
  for (std::size_t i = 0; i < a.pieces().size(); ++i) {
    EXPECT_EQ(a.pieces()[i].vertices, b.pieces()[i].vertices);
    EXPECT_EQ(a.colors()[i], b.colors()[i]);
  }
  EXPECT_EQ(a.mass().mass, b.mass().mass);
  EXPECT_EQ(a.mass().center, b.mass().center);
  EXPECT_EQ(a.mass().inertia, b.mass().inertia);
  EXPECT_EQ(a.stable_poses().size(), b.stable_poses().size());
  ASSERT_EQ(a.features().size(), b.features().size());
  for (std::size_t i = 0; i < a.features().size(); ++i) {
    EXPECT_EQ(a.features()[i].X_PartFeature.matrix(), b.features()[i].X_PartFeature.matrix());
  }
}

TEST(WithClearance, IsThePartReadWithThatClearance) {
  for (const std::string& name : PartNames()) {
    const auto part = LoadPart(name, 0.0005);
    EXPECT_EQ(part->clearance(), 0.0005);
    ExpectSameGeometry(*PartFile::WithClearance(*part, 0.0005), *part);
    const auto wider = PartFile::WithClearance(*part, 0.0008);
    ExpectSameGeometry(*wider, *LoadPart(name, 0.0008));
    ExpectSameGeometry(*PartFile::WithClearance(*wider, 0.0005), *part);
    EXPECT_EQ(PartFile::MassWithClearance(*part, 0.0008).mass, wider->mass().mass) << name;
    EXPECT_EQ(PartFile::MassWithClearance(*part, 0.0008).center, wider->mass().center) << name;
    EXPECT_EQ(PartFile::MassWithClearance(*part, 0.0008).inertia, wider->mass().inertia) << name;
  }
}

TEST(WithClearance, MovesTheWallsThatAreMarked) {
  int moved = 0;
  for (const std::string& name : PartNames()) {
    const auto part = LoadPart(name, 0.0005);
    const auto wider = PartFile::WithClearance(*part, 0.0008);
    for (std::size_t f = 0; f < part->features().size(); ++f) {
      const auto& walls = part->features()[f].walls;
      ASSERT_EQ(walls.size(), wider->features()[f].walls.size());
      for (std::size_t w = 0; w < walls.size(); ++w) {
        const Wall& after = wider->features()[f].walls[w];
        EXPECT_EQ(walls[w].moves_with_clearance, after.moves_with_clearance);
        const double back =
            part->faces()[walls[w].face.index()].offset - wider->faces()[after.face.index()].offset;
        // The sides of a round hole's polygon are at the circle's radius times the cosine of half
        // of a side's angle. They therefore move less than the circle grows.
        const double round = name == "round-block" ? 0.0003 * (1 - std::cos(M_PI / 64)) : 0;
        EXPECT_NEAR(back, walls[w].moves_with_clearance ? 0.0003 - round : 0, 1e-12) << name;
        moved += walls[w].moves_with_clearance ? 1 : 0;
      }
    }
  }
  EXPECT_GE(moved, 12) << "both sides of both axes of the holes of three parts";
}

TEST(WithClearance, BelowZeroTheHoleIsTooNarrow) {
  const auto tight = PartFile::WithClearance(*LoadPart("block", 0.0005), -0.0002);
  EXPECT_GT(tight->mass().mass, LoadPart("block", 0)->mass().mass);
}

TEST(WithClearance, MustLeaveAPocketAndItsWalls) {
  const auto block = LoadPart("block");
  EXPECT_THROW(PartFile::WithClearance(*block, -1), InputError);
  EXPECT_THROW(PartFile::WithClearance(*block, 1), InputError);
}

TEST(PartModelTest, MassAndVolumeOfTheBlock) {
  const auto exact = LoadPart("block", 0);
  const double hole = 2.8 * 1.5 * 1.5, pin_hole = 0.5 * 0.25 * 0.25;
  EXPECT_NEAR(exact->mass().mass, 700 * (3 * 3 * 6.5 - hole - pin_hole) * kCubicInch, 1e-9);
  const double wide = 1.5 * kInch + 2 * 0.0005;  // the clearance is on each side
  EXPECT_NEAR(LoadPart("block", 0.0005)->mass().mass,
              700 * ((58.5 - pin_hole) * kCubicInch - 2.8 * kInch * wide * wide), 1e-9);
  EXPECT_NEAR(exact->mass().center.y(), 0, 1e-12);
}

TEST(PartModelTest, MassAndCentreOfThePeg) {
  const auto peg = LoadPart("peg");
  const double plate = 9 - 0.0625, shaft = 2.25 * 2.75;
  EXPECT_NEAR(peg->mass().mass, 700 * (plate + shaft) * kCubicInch, 1e-9);
  EXPECT_NEAR(peg->mass().center.x(), kInch * (-0.5 * plate + 1.375 * shaft) / (plate + shaft),
              1e-9);
  EXPECT_NEAR(peg->mass().center.z(), kInch * 0.0625 * 1.125 / (plate + shaft), 1e-9);
}

TEST(PartModelTest, SurfaceOfThePeg) {
  const double base = 9 - 0.0625, shoulder = 9 - 2.25 - 0.0625, sides = 4 * 3;
  const double shaft = 4 * 1.5 * 2.75 + 2.25, pin_hole = 4 * 0.25;
  EXPECT_NEAR(SurfaceOf(*LoadPart("peg")),
              (base + shoulder + sides + shaft + pin_hole) * kSquareInch, 1e-9);
}

TEST(PartModelTest, TheShoulderOfThePegIsARingAroundTheShaft) {
  const auto peg = LoadPart("peg");
  const Face& shoulder = peg->faces()[FaceAt(*peg, Vector3::UnitX(), 0).index()];
  EXPECT_NEAR(geometry::Area(shoulder.patches), (9 - 2.25 - 0.0625) * kSquareInch, 1e-9);
  const auto at = [&](double y, double z, double half) {
    return SquareAround(shoulder, Vector3(0, y, z) * kInch, half * kInch);
  };
  EXPECT_TRUE(shoulder.Covers(at(1.125, 0, 0.37)));
  EXPECT_FALSE(shoulder.Covers(at(1.125, 0, 0.38)));  // over edge and shaft
  EXPECT_FALSE(shoulder.Covers(at(0, 0, 0.5)));       // under the shaft
  EXPECT_FALSE(shoulder.Covers(at(0, -1.125, 0.2)));  // over the alignment hole
  EXPECT_TRUE(shoulder.Covers(at(0, 1.125, 0.3)));
  EXPECT_EQ(Indices(peg->FeaturesUnder(FaceAt(*peg, Vector3::UnitX(), 0), at(0, -1.1, 0.1))),
            std::vector<int>{8});
  EXPECT_EQ(Indices(peg->FeaturesUnder(FaceAt(*peg, Vector3::UnitX(), 0), at(0, -1.1, 0.2))),
            (std::vector<int>{2, 8}));
  EXPECT_EQ(Indices(peg->FeaturesUnder(FaceAt(*peg, Vector3::UnitX(), 0), at(0, 1.1, 0.2))),
            std::vector<int>{2});
}

TEST(PartModelTest, SurfacesAreClosed) {
  for (const std::string& name : PartNames()) {
    const auto part = LoadPart(name);
    // Walls that meet at an obtuse angle each cover 0.1 micrometres of the other.
    const bool is_slanting = name == "octagonal-block" || name == "round-block";
    const double strips = is_slanting ? 1e-7 : 1e-12;
    ExpectClosedSurface(*part, part->mass().mass / 700, strips);
  }
}

// Returns the area 8 tan(22.5 degrees) r^2 of an octagon with the inscribed radius r.
double OctagonAround(double radius) { return 8 * (std::sqrt(2) - 1) * radius * radius; }

TEST(PartModelTest, SurfacesOfTheOctagonalPartsAreClosed) {
  const double plate = 2.5 * 3.2 - 0.0625, shaft = 2.75 * OctagonAround(0.75);
  ExpectClosedSurface(*LoadPart("octagonal-peg"), (plate + shaft) * kCubicInch, 1e-12);
  for (double clearance : {-0.0002, 0.0, 0.0005, 0.002}) {
    const double hole = 2.8 * kInch * OctagonAround(0.75 * kInch + clearance);
    const double body = (58.5 - 0.5 * 0.0625) * kCubicInch;
    // Walls that meet at an obtuse angle each cover 0.1 micrometres of the other.
    const double strips = 1e-7 * 16 * 2.8 * kInch * kInch;
    ExpectClosedSurface(*LoadPart("octagonal-block", clearance), body - hole, strips);
  }
}

// The area is eight times the triangle over half a side: 2 (sqrt 2 - 1) w^2 for the width w across
// flats.
TEST(PartModelTest, FourTurnedBoxesMakeAnExactOctagonalPrism) {
  const auto part = ParsePart(OctagonalPeg());
  const double section = 2 * (std::sqrt(2) - 1) * 0.04 * 0.04;
  EXPECT_EQ(part->faces().size(), 10u);
  ExpectClosedSurface(*part, section * 0.06, 1e-12);
  EXPECT_NEAR(part->mass().mass, 1000 * section * 0.06, 1e-3 * 1000 * section * 0.06);
  EXPECT_NEAR(geometry::Area(part->faces()[FaceAt(*part, Vector3::UnitX(), 0.06).index()].patches),
              section, 1e-12);
}

// Boxes on a coarse grid overlap and touch in every possible way.
TEST(PartModelTest, RandomUnionsHaveClosedSurfacesOfOneSkin) {
  RandomStream random(kSeed, "unions");
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<geometry::Box> boxes;
    for (int i = 0; i < 5; ++i) {
      Vector3 low, size;
      for (int k = 0; k < 3; ++k) {
        low[k] = 0.01 * random.Index(4);
        size[k] = 0.01 * (1 + random.Index(3));
      }
      boxes.push_back(geometry::Box::FromCorners(low, low + size));
    }
    const double volume = geometry::MassOf(geometry::HullsOf(boxes), 1).mass;
    double enclosed = 0;
    for (const Face& face : ExposedFaces(geometry::HullsOf(boxes))) {
      enclosed += geometry::Area(face.patches) * face.offset / 3;
      for (std::size_t i = 0; i < face.patches.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_GT(geometry::Gap(face.patches[i], face.patches[j]), -1e-9);
        }
      }
    }
    EXPECT_NEAR(enclosed, volume, 1e-12) << "seed " << kSeed << " trial " << trial;
  }
}

// Just below every patch there is material, and just above it there is none.
TEST(PartModelTest, FacesSeparateMatterFromAir) {
  std::vector<std::shared_ptr<const PartModel>> parts = {ParsePart(OctagonalPeg())};
  for (const std::string& name : PartNames()) parts.push_back(LoadPart(name));
  RandomStream random(kSeed, "skin");
  for (const auto& part : parts) {
    for (const Face& face : part->faces()) {
      for (const Polygon& patch : face.patches) {
        for (int i = 0; i < 10; ++i) {
          const Vector2 corner = patch[random.Index(static_cast<int>(patch.size()))];
          const Vector2 p = geometry::Centroid(patch) +
                            random.Uniform(0, 0.999) * (corner - geometry::Centroid(patch));
          const Vector3 on = face.X_PartFace * Vector3(p.x(), p.y(), 0);
          EXPECT_NEAR(face.normal.dot(on), face.offset, 1e-9);
          EXPECT_TRUE(IsSolid(*part, on - 1e-5 * face.normal)) << part->name();
          EXPECT_FALSE(IsSolid(*part, on + 1e-5 * face.normal)) << part->name();
        }
      }
    }
  }
}

TEST(PartModelTest, MatingFramesLookOutOfHolesAndAlongShafts) {
  const auto block = LoadPart("block");
  const Pose hole = block->FindFeature(FeatureNumber(7))->X_PartFeature;
  EXPECT_LT((hole.translation() - kInch * Vector3(3, 0, 3.25)).norm(), 1e-9);
  EXPECT_LT((hole.linear().col(2) - Vector3::UnitX()).norm(), 1e-9);
  const auto peg = LoadPart("peg");
  const Pose tip = peg->FindFeature(FeatureNumber(7))->X_PartFeature;
  EXPECT_LT((tip.translation() - kInch * Vector3(2.75, 0, 0)).norm(), 1e-9);
  EXPECT_LT((tip.linear().col(2) - Vector3::UnitX()).norm(), 1e-9);
  const Pose base = peg->FindFeature(FeatureNumber(1))->X_PartFeature;
  EXPECT_NEAR(base.translation().x(), -kInch, 1e-9);
  EXPECT_LT((base.linear().col(2) + Vector3::UnitX()).norm(), 1e-9);
  EXPECT_EQ(block->FindFeature(FeatureNumber(9)), nullptr);
}

// The pose is Ta of the paper, in which the peg's x axis points into the block. In the mated pose,
// each hole in the plate of the peg and each shaft is on one axis with its hole.
TEST(PartModelTest, MatedFeaturesMeet) {
  const Pose X_FixedHeld = geometry::PoseFromColumns(
      -Vector3::UnitX(), Vector3::UnitY(), -Vector3::UnitZ(), kInch * Vector3(3, 0, 3.25));
  const auto expect_on_axis = [&](const PartModel& held, const PartModel& fixed, int of_held,
                                  int of_fixed, const Pose& X) {
    const Pose a = X * held.FindFeature(FeatureNumber(of_held))->X_PartFeature;
    const Pose b = fixed.FindFeature(FeatureNumber(of_fixed))->X_PartFeature;
    EXPECT_LT((b.inverse() * a.translation()).head<2>().norm(), 1e-9) << of_held;
    EXPECT_NEAR(a.linear().col(2).dot(b.linear().col(2)), -1, 1e-9) << of_held;
  };
  const auto peg = LoadPart("peg"), block = LoadPart("block");
  expect_on_axis(*peg, *block, 7, 7, X_FixedHeld);
  expect_on_axis(*peg, *block, 8, 8, X_FixedHeld);
  const auto keyed_peg = LoadPart("keyed-peg"), keyed_block = LoadPart("keyed-block");
  for (int feature : {7, 8, 9}) {
    expect_on_axis(*keyed_peg, *keyed_block, feature, feature, X_FixedHeld);
  }
  const auto twin = LoadPart("twin-block");
  for (const auto& [z, hole] : {std::pair(1.6, 7), std::pair(4.9, 9)}) {
    const Pose X = geometry::Translation(0, 0, (z - 3.25) * kInch) * X_FixedHeld;
    expect_on_axis(*peg, *twin, 7, hole, X);
    expect_on_axis(*peg, *twin, 8, hole + 1, X);
  }
  for (int feature : {7, 8, 9}) {
    expect_on_axis(*LoadPart("stepped-peg"), *LoadPart("stepped-block"), feature, feature,
                   X_FixedHeld);
  }
  for (int feature : {7, 8}) {
    expect_on_axis(*LoadPart("octagonal-peg"), *LoadPart("octagonal-block"), feature, feature,
                   X_FixedHeld);
    expect_on_axis(*LoadPart("t-slide"), *LoadPart("t-rail"), feature, feature, X_FixedHeld);
  }
}

// With clearance the mated parts touch only at the shoulder. A shaft as wide as the hole, moved a
// little to any side, goes through its wall.
TEST(PartModelTest, MatedPartsFit) {
  const Pose X_FixedHeld = geometry::PoseFromColumns(
      -Vector3::UnitX(), Vector3::UnitY(), -Vector3::UnitZ(), kInch * Vector3(3, 0, 3.25));
  const std::vector<Vector3> to_sides = {Vector3::UnitY(), -Vector3::UnitY(), Vector3::UnitZ(),
                                         -Vector3::UnitZ()};
  std::vector<Vector3> to_eight = to_sides;
  for (double y : {1, -1}) {
    for (double z : {1, -1}) to_eight.push_back(Vector3(0, y, z).normalized());
  }
  struct Pair {
    const char* held;
    const char* fixed;
    std::vector<Vector3> across;  // the walls
  };
  for (const auto& [held, fixed, across] :
       {Pair{"peg", "block", to_sides}, Pair{"keyed-peg", "keyed-block", to_sides},
        Pair{"stepped-peg", "stepped-block", to_sides}, Pair{"t-slide", "t-rail", to_sides},
        Pair{"octagonal-peg", "octagonal-block", to_eight}}) {
    const auto peg = LoadPart(held), block = LoadPart(fixed, 0.0005);
    const auto overlap = [&](const Vector3& aside) {
      return Overlaps(block->shape(), Pose::Identity(), peg->shape(),
                      geometry::Translation(1e-6 * Vector3::UnitX() + aside) * X_FixedHeld, 1e-6);
    };
    EXPECT_FALSE(overlap(Vector3::Zero())) << held;
    for (const Vector3& direction : across) {
      EXPECT_FALSE(overlap(0.00049 * direction)) << held << " " << direction.transpose();
      EXPECT_TRUE(overlap(0.00052 * direction)) << held << " " << direction.transpose();
    }
  }
}

TEST(PartModelTest, HolesKnowTheirMouthsAndWalls) {
  const auto block = LoadPart("block");
  const Feature& hole = *block->FindFeature(FeatureNumber(7));
  EXPECT_TRUE(hole.faces.empty());
  ASSERT_EQ(hole.mouths.size(), 1u);
  EXPECT_EQ(hole.mouths[0].face, FaceAt(*block, Vector3::UnitX(), 3 * kInch));
  EXPECT_NEAR(geometry::Area(hole.mouths[0].outline), std::pow(1.5 * kInch + 0.001, 2), 1e-9);
  EXPECT_EQ(hole.walls.size(), 5u);
  const auto peg = LoadPart("peg");
  const Feature& pin_hole = *peg->FindFeature(FeatureNumber(8));
  EXPECT_EQ(pin_hole.mouths.size(), 2u) << "it goes through";
  EXPECT_EQ(pin_hole.walls.size(), 4u);
  EXPECT_EQ(peg->FindFeature(FeatureNumber(7))->faces.size(), 5u);
}

TEST(PartModelTest, PocketsOfSeveralSolidsMakeOneHole) {
  const auto block = LoadPart("octagonal-block");
  const Feature& hole = *block->FindFeature(FeatureNumber(7));
  ASSERT_EQ(hole.mouths.size(), 1u);
  EXPECT_EQ(hole.mouths[0].face, FaceAt(*block, Vector3::UnitX(), 3 * kInch));
  EXPECT_EQ(hole.mouths[0].outline.size(), 8u);
  EXPECT_NEAR(geometry::Area(hole.mouths[0].outline), OctagonAround(0.75 * kInch + 0.0005), 1e-12);
  EXPECT_LT((hole.X_PartFeature.translation() - kInch * Vector3(3, 0, 3.25)).norm(), 1e-12);
  int sides = 0;
  for (const Wall& wall : hole.walls) {
    const Face& face = block->faces()[wall.face.index()];
    if (std::abs(face.normal.x()) > 0.5) continue;  // the floor
    ++sides;
    EXPECT_TRUE(wall.moves_with_clearance);
    EXPECT_NEAR(face.offset - face.normal.dot(hole.X_PartFeature.translation()),
                -0.75 * kInch - 0.0005, 1e-12);
  }
  EXPECT_EQ(sides, 8);
}

TEST(PartModelTest, PosesAreFoundByName) {
  const auto block = LoadPart("block");
  for (const StablePose& pose : block->stable_poses()) {
    const StablePoseId id = block->FindStablePose(pose.name);
    EXPECT_EQ(block->stable_poses()[id.index()].label, pose.label);
  }
  EXPECT_TRUE(block->FindStablePose("nowhere").IsNone());
  EXPECT_TRUE(block->FindStablePose("").IsNone());
}

}  // namespace
}  // namespace assay::domain::part_model_test
