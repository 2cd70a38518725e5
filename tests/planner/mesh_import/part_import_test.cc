#include "planner/mesh_import/parts/part_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/input_files/document.h"
#include "planner/base/input_files/input_error.h"
#include "planner/mesh_import/parts/account.h"
#include "tests/planner/mesh_import/made_mesh.h"
#include "tests/planner/mesh_import/part_file_volume.h"

namespace assay::mesh_import {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

ImportedPart PartOfMesh(const TriangleMesh& mesh, const ImportOptions& options = {}) {
  return Import({Written("made.obj", ObjText(mesh))}, "made-part", options);
}

Document FileOf(const ImportedPart& part) { return Document::Parse(part.PartFile(), "part.yaml"); }

std::vector<std::string> WhatOf(const ImportedPart& part) {
  std::vector<std::string> texts;
  for (const SketchFeature& feature : part.sketch.features) texts.push_back(feature.what);
  return texts;
}

const Post& FirstPost(const ImportedPart& part) { return part.sketch.solids.at(0).post.value(); }

// A block with three pockets of different kinds.
TriangleMesh DrilledPlate() {
  const Curve block = RectangleOf(60, 40);
  const Curve bore = CircleOf(8.05, 72, {-15, 0});
  const Curve wide = CircleOf(8.55, 72, {-15, 0});
  const Curve square = RectangleOf(10, 6, {15, 5});
  const Curve hexagon = {{18, -10}, {16.5, -7.5},  {13.5, -7.5},
                         {12, -10}, {13.5, -12.5}, {16.5, -12.5}};
  return Through({{0, block}, {0.5, block}, {12, block}}, {{{0, bore}, {11.5, bore}, {12, wide}},
                                                           {{0, square}, {12, square}},
                                                           {{0, hexagon}, {12, hexagon}}});
}

TEST(PartImport, PegWithChamfers) {
  const ImportedPart part = PartOfMesh(ChamferedPeg(7.9915, 50, 0.5, 72));
  const Post& post = FirstPost(part);
  ASSERT_TRUE(post.at_low.IsCircle());
  EXPECT_NEAR(post.at_low.radius, 7.9915e-3, 1e-8);
  EXPECT_FALSE(post.at_low.is_circle_of_sides);
  EXPECT_NEAR(post.Height(), 50e-3, 1e-8);
  EXPECT_NEAR(post.chamfer_high.across, 0.5e-3, 1e-7);
  EXPECT_NEAR(post.chamfer_low.along, 0.5e-3, 1e-7);
  EXPECT_THAT(WhatOf(part), ElementsAre("end toward +z", "end toward -z",
                                        "round shaft, 15.983 mm, 50 mm long, tip toward +z",
                                        "round shaft, 15.983 mm, 50 mm long, tip toward -z"));
  EXPECT_NEAR(part.sketch.features[2].chamfer, 0.5e-3, 1e-7);
  // The middle of a side is nearer to the axis than its ends.
  EXPECT_NEAR(part.Distance(), 7.9915e-3 * (1 - std::cos(std::numbers::pi / 72)), 2e-6);
}

// A mesh whose sides touch the circle from outside has round numbers between its sides.
TEST(PartImport, CircleOfSides) {
  const double corners = 8 / std::cos(std::numbers::pi / 32);
  const ImportedPart part = PartOfMesh(Extruded(CircleOf(corners, 32), 20));
  EXPECT_TRUE(FirstPost(part).at_low.is_circle_of_sides);
  EXPECT_NEAR(FirstPost(part).at_low.radius, 8e-3, 1e-8);
  EXPECT_THAT(ReadmeText(part), HasSubstr("through the sides of 32 sides"));
}

TEST(PartImport, PlateWithHoles) {
  const ImportedPart part = PartOfMesh(DrilledPlate());
  EXPECT_EQ(part.sketch.solids.size(), 1u);
  ASSERT_EQ(part.sketch.pockets.size(), 3u);
  EXPECT_THAT(WhatOf(part),
              ElementsAre("end toward +z", "end toward -z", "side toward -y", "side toward +x",
                          "side toward +y", "side toward -x",
                          "round hole, 16.1 mm, through, mouth toward +z",
                          "round hole, 16.1 mm, through, mouth toward -z",
                          "rectangular hole, 10 x 6 mm, through, mouth toward +z",
                          "rectangular hole, 10 x 6 mm, through, mouth toward -z",
                          "hole with 6 sides, 6 x 5 mm, through, mouth toward +z",
                          "hole with 6 sides, 6 x 5 mm, through, mouth toward -z",
                          "rectangular shaft, 60 x 40 mm, 12 mm long, tip toward +z",
                          "rectangular shaft, 60 x 40 mm, 12 mm long, tip toward -z"));
  EXPECT_NEAR(part.sketch.features[6].chamfer, 0.5e-3, 1e-7);
  EXPECT_NEAR((part.sketch.features[6].direction - Vector3::UnitZ()).norm(), 0, 1e-12);
  const Value root = FileOf(part).root();
  EXPECT_NEAR(root.At("pockets").At("hole-1").At("cylinder").At("radius").Number(), 8.05, 1e-4);
  // The part file has the volume of the mesh without its chamfer, and with a truly round hole.
  const double sides = 72 / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi / 72);
  const double mesh_volume = DrilledPlate().Volume();
  const double bore = std::numbers::pi * 8.05 * 8.05 * 12 * (1 - sides);
  const double chamfer = sides * std::numbers::pi *
                         (0.5 * (8.05 * 8.05 + 8.05 * 8.55 + 8.55 * 8.55) / 3 - 0.5 * 8.05 * 8.05);
  EXPECT_NEAR(VolumeInFile(root), mesh_volume - bore + chamfer, 0.05);
}

TEST(PartImport, BlindHole) {
  const ImportedPart part =
      PartOfMesh(BlockWithBlindHole(RectangleOf(40, 30), RectangleOf(16, 16), 8, 20));
  EXPECT_EQ(part.Pieces(), 2);
  EXPECT_THAT(WhatOf(part), Contains("square hole, 16 mm, 12 mm deep"));
  EXPECT_NEAR(VolumeInFile(FileOf(part).root()), 40 * 30 * 20 - 16 * 16 * 12, 1e-3);
  EXPECT_LT(part.Distance(), 1e-9);
}

TEST(PartImport, FootWithStem) {
  const ImportedPart part = PartOfMesh(FootWithStem(RectangleOf(40, 30), CircleOf(6, 48), 10, 35));
  EXPECT_EQ(part.Pieces(), 2);
  EXPECT_EQ(WhatOf(part).back(), "round shaft, 12 mm, 25 mm long, tip toward +z");
  // The faces are the shoulder, the tip, the base and four sides. The foot is a shaft, too: with
  // the stem ahead it could go into a rectangular hole.
  ASSERT_EQ(WhatOf(part).size(), 7u + 3);
  EXPECT_EQ(WhatOf(part)[7], "rectangular shaft, 40 x 30 mm, 10 mm long, tip toward +z");
  EXPECT_EQ(WhatOf(part)[8], "rectangular shaft, 40 x 30 mm, 10 mm long, tip toward -z");
}

// A slot in a side becomes a pocket. The pocket of an undercut slot opens along the length of the
// slot.
TEST(PartImport, Slots) {
  const Curve slotted = {{0, 0},   {40, 0},  {40, 30}, {28, 30},
                         {28, 20}, {12, 20}, {12, 30}, {0, 30}};
  const ImportedPart slot = PartOfMesh(Extruded(slotted, 50));
  EXPECT_EQ(slot.Pieces(), 2);
  EXPECT_EQ(WhatOf(slot).back(), "rectangular slot, 16 x 10 mm, 50 mm long");
  EXPECT_NEAR((slot.sketch.features.back().direction - Vector3::UnitY()).norm(), 0, 1e-9);
  const Curve undercut = {{0, 0},   {40, 0},  {40, 30}, {25, 30}, {25, 24}, {30, 24},
                          {30, 16}, {10, 16}, {10, 24}, {15, 24}, {15, 30}, {0, 30}};
  const ImportedPart t_slot = PartOfMesh(Extruded(undercut, 50));
  EXPECT_EQ(t_slot.Pieces(), 2);
  EXPECT_EQ(WhatOf(t_slot).back(), "slot with 8 sides, 20 x 14 mm, through, mouth toward -z");
  EXPECT_NEAR(VolumeInFile(FileOf(t_slot).root()), 50 * (40 * 30 - 20 * 8 - 10 * 6), 1e-3);
}

// The T of a slide has two solids in one: a prism that is not convex.
TEST(PartImport, ConcaveOutline) {
  const Curve t = {{-5, 0}, {5, 0}, {5, 12}, {12, 12}, {12, 20}, {-12, 20}, {-12, 12}, {-5, 12}};
  const ImportedPart part = PartOfMesh(Extruded(t, 40));
  EXPECT_EQ(part.Pieces(), 1);
  EXPECT_THAT(part.PartFile(), HasSubstr("prism: {outline: ["));
  EXPECT_NEAR(VolumeInFile(FileOf(part).root()), 40 * (10 * 12 + 24 * 8), 1e-3);
}

// A shaft could stand in a corner of an angled pocket, and not in its hull. The pocket stays in the
// part, and is no hole of it.
TEST(PartImport, AnAngledPocketIsNoHole) {
  const Curve angled = {{-8, -8}, {8, -8}, {8, 0}, {0, 0}, {0, 8}, {-8, 8}};
  const Curve block = RectangleOf(40, 30);
  const ImportedPart part =
      PartOfMesh(Through({{0, block}, {12, block}}, {{{0, angled}, {12, angled}}}));
  EXPECT_THAT(WhatOf(part), Not(Contains(HasSubstr("hole"))));
  EXPECT_NEAR(VolumeInFile(FileOf(part).root()), 12 * (40 * 30 - 16 * 16 + 8 * 8), 1e-3);
}

TEST(PartImport, RoundedRectangleBecomesABox) {
  Curve rounded;
  for (const Vector2& corner :
       {Vector2(7.4, -4.4), Vector2(7.4, 4.4), Vector2(-7.4, 4.4), Vector2(-7.4, -4.4)}) {
    const double first = std::atan2(corner.y(), corner.x()) > 0 ? (corner.x() > 0 ? 0 : 0.5)
                                                                : (corner.x() > 0 ? -0.5 : 1);
    for (int i = 0; i <= 8; ++i) {
      const double angle = std::numbers::pi * (first + i / 16.0);
      rounded.push_back(corner + 0.6 * Vector2(std::cos(angle), std::sin(angle)));
    }
  }
  const ImportedPart part = PartOfMesh(Extruded(rounded, 50));
  const Contour& outline = FirstPost(part).at_low;
  EXPECT_EQ(outline.kind, Contour::Kind::kRectangle);
  EXPECT_NEAR(outline.left_out, 0.6e-3 * (std::sqrt(2) - 1), 1e-6);
  EXPECT_NEAR(part.Distance(), outline.left_out, 1e-6);
  EXPECT_THAT(ReadmeText(part), HasSubstr("rounded or bevelled corners, up to 0.2485 mm"));
}

TEST(PartImport, UnitsAreSaidAndCanBeSet) {
  const TriangleMesh peg = ChamferedPeg(8, 50, 0.5, 36);
  EXPECT_THAT(AccountOf(PartOfMesh(peg)).front(),
              AllOf(HasSubstr("is mm"), HasSubstr("found from the size")));
  const ImportedPart inches = PartOfMesh(peg, {.unit = MeshUnit::kInch});
  EXPECT_THAT(AccountOf(inches).front(), HasSubstr("is inch (as asked for)"));
  EXPECT_NEAR(FirstPost(inches).at_low.radius, 8 * 0.0254, 1e-6);
}

// Two bodies in two files may have two axes.
TEST(PartImport, FilesOfOnePart) {
  const TriangleMesh block = Extruded(RectangleOf(40, 40), 40);
  Matrix3 along_x;  // z of the peg becomes x
  along_x << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  TriangleMesh peg = Extruded(CircleOf(8, 48), 30).Transformed(along_x);
  for (Vector3& vertex : peg.vertices) vertex += Vector3(20, 0, 20);
  const ImportedPart part = Import(
      {Written("block.stl", BinaryStl(block)), Written("peg.stl", StlText(peg))}, "made-part", {});
  EXPECT_EQ(part.Pieces(), 2);
  EXPECT_THAT(part.PartFile(), HasSubstr("cylinder: {from: [20, 0, 20], to: [50, 0, 20]"));
  EXPECT_EQ(WhatOf(part).back(), "round shaft, 16 mm, 30 mm long, tip toward +x");
}

// One body may have two axes, too: it is cut where a stem stands on a side.
TEST(PartImport, BodyWithTwoAxes) {
  TriangleMesh mesh = FootWithStem(RectangleOf(40, 40), CircleOf(6, 48), 30, 60);
  std::erase_if(mesh.triangles, [&](const Triangle& triangle) {
    return mesh.AreaVector(triangle).x() > 0 && mesh.Centroid(triangle).x() > 19;
  });
  const Curve stem = CircleOf(5, 36, {0, 15});
  MadeMesh side;  // its z is the body's x
  side.AddEnd(20, RectangleOf(40, 30, {0, 15}), {stem}, true);
  side.AddWall({{20, stem}, {45, stem}}, false);
  side.AddEnd(45, stem, {}, true);
  Matrix3 along_x;
  along_x << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  Append(mesh, side.mesh.Transformed(along_x), {0, 0, 0});
  const ImportedPart part = PartOfMesh(mesh);
  EXPECT_EQ(part.Pieces(), 3);
  const std::vector<std::string> what = WhatOf(part);
  EXPECT_THAT(what, ::testing::IsSupersetOf({"round shaft, 12 mm, 30 mm long, tip toward +z",
                                             "round shaft, 10 mm, 25 mm long, tip toward +x"}));
  EXPECT_NEAR(VolumeInFile(FileOf(part).root()),
              40 * 40 * 30 + std::numbers::pi * (36 * 30 + 25 * 25), 1);
}

Matrix3 SomeTurn() {
  return (Eigen::AngleAxisd(0.7, Vector3(1, 2, -0.5).normalized()) *
          Eigen::AngleAxisd(2.1, Vector3::UnitX()))
      .toRotationMatrix();
}

// Turned, mirrored and scaled files give turned, mirrored and scaled parts.
TEST(PartImport, LawsOfSymmetry) {
  const std::vector<TriangleMesh> meshes = {
      DrilledPlate(), ChamferedPeg(8, 50, 0.5, 36),
      FootWithStem(RectangleOf(40, 30), RectangleOf(12, 10), 10, 35)};
  for (const TriangleMesh& mesh : meshes) {
    const ImportedPart part = PartOfMesh(mesh);
    const auto expect_like = [&](const ImportedPart& other, double scale) {
      EXPECT_EQ(other.Pieces(), part.Pieces());
      EXPECT_EQ(other.sketch.features.size(), part.sketch.features.size());
      EXPECT_NEAR(other.Distance(), scale * part.Distance(), 2e-6);
      EXPECT_NEAR(VolumeInFile(FileOf(other).root()),
                  std::pow(scale, 3) * VolumeInFile(FileOf(part).root()),
                  1e-5 * VolumeInFile(FileOf(part).root()));
    };
    expect_like(PartOfMesh(mesh.Transformed(SomeTurn())), 1);
    expect_like(PartOfMesh(mesh.Transformed(2.5 * SomeTurn())), 2.5);
    TriangleMesh mirrored = mesh.Transformed(Vector3(1, -1, 1).asDiagonal());
    expect_like(PartOfMesh(mirrored), 1);  // the repair turns its triangles outward
    for (int axis = 0; axis < 3; ++axis) {
      Matrix3 renamed;
      for (int i = 0; i < 3; ++i) renamed.col(i) = Vector3::Unit((axis + i) % 3);
      const ImportedPart along = PartOfMesh(mesh.Transformed(renamed));
      expect_like(along, 1);
      EXPECT_TRUE(along.sketch.R_FilePart.isIdentity(0));
    }
  }
}

TriangleMesh Ball(double radius, int rings) {
  MadeWall wall;
  for (int i = 0; i <= rings; ++i) {
    const double angle = std::numbers::pi * (0.02 + 0.96 * i / rings);
    wall.push_back({-radius * std::cos(angle), CircleOf(radius * std::sin(angle), 2 * rings)});
  }
  return Through(wall, {});
}

// A body that would be a stack of many rings is a convex piece, and has no mating feature.
TEST(PartImport, BallIsOneConvexPiece) {
  const ImportedPart part = PartOfMesh(Ball(20, 30));
  EXPECT_EQ(part.Pieces(), 1);
  EXPECT_FALSE(part.sketch.CanBeMated());
  EXPECT_THAT(part.PartFile(), HasSubstr("mesh: {file: body.obj, units: mm, up: z}"));
  EXPECT_EQ(part.PieceFiles().at(0).first, "body.obj");
  EXPECT_THAT(AccountOf(part).back(), HasSubstr("cannot be mated"));
  const TriangleMesh piece = ReadMeshFile(Written("piece.obj", part.PieceFiles().at(0).second));
  EXPECT_NEAR(piece.Volume(), 4.0 / 3 * std::numbers::pi * 8000, 0.04 * 33510);
}

// Returns a closed curve with points in the middles of its sides, too, rounded to micrometres as in
// many files.
Curve Subdivided(const Curve& curve) {
  Curve finer;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    for (const double share : {0.0, 0.25, 0.5, 0.75}) {
      const Vector2 p = curve[i] + share * (curve[(i + 1) % curve.size()] - curve[i]);
      finer.emplace_back(std::round(p.x() * 1e3) / 1e3, std::round(p.y() * 1e3) / 1e3);
    }
  }
  return finer;
}

TEST(PartImport, SubdividedSidesOfACircleAreNoCorners) {
  for (const int sides : {20, 30, 36, 52}) {
    const Post post = FirstPost(PartOfMesh(Extruded(Subdivided(CircleOf(2.776, sides)), 20)));
    ASSERT_TRUE(post.at_low.IsCircle()) << sides;
    EXPECT_EQ(post.at_low.corners.size(), sides);
    EXPECT_NEAR(post.at_low.radius, 2.776e-3, 1.5e-6);
  }
}

// A pin on a knob with five sides, which becomes round in ten rings. Its tip is rounded.
TriangleMesh KnobWithPin() {
  constexpr int kPoints = 40;
  const auto curve = [](double roundness, double radius) {
    Curve points;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * std::numbers::pi * i / kPoints;
      const double in_side = std::remainder(angle, 2 * std::numbers::pi / 5);
      const double pentagon = std::cos(std::numbers::pi / 5) / std::cos(in_side);
      points.push_back(radius * (roundness + (1 - roundness) * pentagon) *
                       Vector2(std::cos(angle), std::sin(angle)));
    }
    return points;
  };
  MadeWall wall = {{0, curve(0, 15)}};
  for (int i = 0; i <= 10; ++i) wall.push_back({8 + 0.4 * i, curve(0.1 * i, 15 - 0.9 * i)});
  wall.push_back({38.5, curve(1, 6)});
  for (int i = 1; i <= 6; ++i) {
    const double angle = std::numbers::pi / 12 * i;
    wall.push_back({38.5 + 1.5 * std::sin(angle), curve(1, 4.5 + 1.5 * std::cos(angle))});
  }
  return Through(wall, {});
}

// Where the section changes its shape, steps stand for the body. They have less material than the
// body. The pin is exact, and can be mated.
TEST(PartImport, StepsStandForWhatIsNoExtrusion) {
  const TriangleMesh mesh = KnobWithPin();
  const ImportedPart part = PartOfMesh(mesh);
  EXPECT_THAT(WhatOf(part), ::testing::Contains("round shaft, 12 mm, 28 mm long, tip toward +z"));
  EXPECT_GT(part.sketch.features.back().chamfer, 1e-3);
  EXPECT_LT(part.sketch.features.back().chamfer, 1.5e-3) << "the tip is rounded by 1.5 mm";
  EXPECT_GT(part.Pieces(), 5);
  EXPECT_LT(part.Distance(), 0.01 * part.sketch.size);
  EXPECT_THAT(part.bodies.at(0).shape.volume_share,
              AllOf(::testing::Lt(0.0), ::testing::Gt(-0.05)));
  EXPECT_THAT(AccountOf(part).at(2), HasSubstr("steps"));
}

TEST(PartImport, ErrorsNameTheFile) {
  TriangleMesh open = Ball(20, 20);
  open.triangles.resize(open.triangles.size() - 300);
  try {
    PartOfMesh(open);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("made.obj:"), HasSubstr("triangle ")));
  }
  const TriangleMesh tiny = ChamferedPeg(8e-6, 50e-6, 0.5e-6, 36);
  EXPECT_THROW(PartOfMesh(tiny), InputError);  // which unit?
}

TEST(PartText, InitialsAndLengths) {
  EXPECT_EQ(InitialOf("round-peg-8mm"), "RPM");
  EXPECT_EQ(InitialOf("peg"), "P");
  EXPECT_EQ(InitialOf("8"), "P");
  EXPECT_EQ(Millimetres(0.0165000004), "16.5");
  EXPECT_EQ(Millimetres(-0.00000001), "0");
}

}  // namespace
}  // namespace assay::mesh_import
