#include "planner/domain/parts/part_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/exposed_faces.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/planner/domain/parts.h"

namespace assay::domain::part_file_test {
namespace {

using testing::HasSubstr;

// A small part that uses every key of the format.
const std::string kFile = R"(format: assay-part/1
name: bracket
initial: BR
units: {length: mm, angle: degree}
density: 1000
friction: 0.3
solids:
  body: {box: [[0, 0, 0], [60, 40, 20]], color: [1, 0, 0, 1]}
  lug: {box: [[20, 10, 20], [40, 30, 50]]}
pockets:
  slot: {cut_from: body, box: [[45, 10, 5], [60, 30, 15]], widen: [y]}
features:
  1: {face: body, normal: [0, 0, -1], what: bottom}
  2: {shaft: lug, axis: [0, 0, 1]}
  3: {hole: slot, axis: [1, 0, 0]}
stable_poses: {upright: [0, 0, -1]}
)";

std::string With(const std::string& old_text, const std::string& new_text) {
  std::string text = kFile;
  const std::size_t at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return text.replace(at, old_text.size(), new_text);
}

std::string ErrorOf(const std::string& text) {
  try {
    ParsePart(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(PartFileTest, ReadsEverything) {
  const auto part = ParsePart(kFile, 0.001);
  EXPECT_EQ(part->name(), "bracket");
  EXPECT_EQ(part->initial(), "BR");
  EXPECT_EQ(part->friction(), 0.3);
  const double slot = 15 * 22 * 10;  // widened by 1 mm on both sides in y only
  EXPECT_NEAR(part->mass().mass, 1000 * (60 * 40 * 20 + 20 * 20 * 30 - slot) * 1e-9, 1e-12);
  EXPECT_EQ(part->features().size(), 3u);
  EXPECT_EQ(part->FindFeature(FeatureNumber(1))->description, "bottom");
  EXPECT_EQ(part->FindFeature(FeatureNumber(2))->description, "shaft");
  EXPECT_FALSE(part->FindStablePose("upright").IsNone());
  ASSERT_EQ(part->colors().size(), part->pieces().size());
  EXPECT_EQ(part->colors().front(), Eigen::Vector4f(1, 0, 0, 1));
}

// Returns the mass that the chamfer of a feature takes from a part without one, kilograms.
double MassOfBevels(const std::string& file, const std::string& axis) {
  std::string chamfered = file;
  chamfered.replace(chamfered.find(axis), axis.size(), axis + ", chamfer: 1.5");
  return ParsePart(file)->mass().mass - ParsePart(chamfered)->mass().mass;
}

// At a height h above its lower end, the bevel leaves out a frame of the breadth h around the tip,
// and takes a frame of the breadth h around the mouth.
TEST(PartFileTest, ChamfersShapeTipsAndMouths) {
  const double c = 1.5;
  const double around_tip = 2 * (20 + 20) * c * c / 2 - 4 * c * c * c / 3;
  EXPECT_NEAR(MassOfBevels(kFile, "axis: [0, 0, 1]"), 1000 * around_tip * 1e-9, 1e-12);
  const double around_mouth = 2 * (20 + 10) * c * c / 2 + 4 * c * c * c / 3;
  EXPECT_NEAR(MassOfBevels(kFile, "axis: [1, 0, 0]"), 1000 * around_mouth * 1e-9, 1e-12);
}

TEST(PartFileTest, FeaturesKeepTheirFramesAndWallsIfChamfered) {
  const auto plain = ParsePart(kFile);
  const auto part = ParsePart(With("axis: [0, 0, 1]}", "axis: [0, 0, 1], chamfer: 1.5}"));
  const auto other = ParsePart(With("axis: [1, 0, 0]}", "axis: [1, 0, 0], chamfer: 1.5}"));
  EXPECT_NEAR(part->FindFeature(FeatureNumber(2))->chamfer, 0.0015, 1e-15);
  EXPECT_EQ(part->FindFeature(FeatureNumber(3))->chamfer, 0);
  EXPECT_TRUE(part->FindFeature(FeatureNumber(2))
                  ->X_PartFeature.isApprox(plain->FindFeature(FeatureNumber(2))->X_PartFeature));
  const Feature& hole = *other->FindFeature(FeatureNumber(3));
  const Feature& straight = *plain->FindFeature(FeatureNumber(3));
  EXPECT_TRUE(hole.X_PartFeature.isApprox(straight.X_PartFeature));
  EXPECT_EQ(hole.walls.size(), straight.walls.size());
  EXPECT_NEAR(geometry::Area(hole.mouths.front().outline),
              geometry::Area(straight.mouths.front().outline), 1e-12);
}

// Each pocket of a hole is bevelled in its own solid, or the other solid would fill the bevels.
TEST(PartFileTest, ChamfersShapeMouthsInSeveralSolids) {
  std::string text = With("pockets:\n",
                          "  cover: {box: [[30, 0, 0], [60, 40, 20]]}\npockets:\n"
                          "  cut: {cut_from: cover, box: [[45, 10, 5], [60, 30, 15]]}\n");
  const std::string hole = "hole: slot";
  text.replace(text.find(hole), hole.size(), "hole: [slot, cut]");
  const double c = 1.5;
  const double around_mouth = 2 * (20 + 10) * c * c / 2 + 4 * c * c * c / 3;
  EXPECT_NEAR(MassOfBevels(text, "axis: [1, 0, 0]"), 1000 * around_mouth * 1e-9, 1e-12);
}

// A chamfer bevels no edge that another solid covers, and nothing beside the shaft.
TEST(PartFileTest, ChamfersLeaveCoveredEdges) {
  std::string text = With("  lug: {box: [[20, 10, 20], [40, 30, 50]]}",
                          "  lug: {box: [[20, 10, 20], [40, 30, 50]]}\n"
                          "  rib: {box: [[40, 10, 20], [50, 30, 50]]}");
  const double c = 1.5;
  // The tip of the lug keeps its edge beside the rib. Its bevels at the ends of this edge go on to
  // the rib.
  const double around = (20 + 2 * 20) * c * c / 2 - 2 * c * c * c / 3;
  EXPECT_NEAR(MassOfBevels(text, "axis: [0, 0, 1]"), 1000 * around * 1e-9, 1e-12);
}

TEST(PartFileTest, EveryPartOfTheRepositoryLoads) {
  for (const std::string& name : PartNames()) {
    for (double clearance : {0.0, 0.0001, 0.0005, 0.002}) {
      const auto part = LoadPart(name, clearance);
      EXPECT_EQ(part->name(), name);
      for (const StablePose& pose : part->stable_poses()) EXPECT_NE(pose.name, "") << name;
    }
  }
}

// A round flange with a round shaft on one side and a round blind hole on the other.
const std::string kRound = R"(format: assay-part/1
name: flange
initial: F
units: {length: mm, angle: degree}
density: 1000
friction: 0.3
solids:
  plate: {cylinder: {from: [0, 0, 0], to: [0, 0, 10], radius: 40, sides: 64}}
  shaft: {cylinder: {from: [5, 0, 10], to: [5, 0, 60], radius: 8, sides: 64}}
pockets:
  hole: {cut_from: plate, cylinder: {from: [-10, 0, 0], to: [-10, 0, 8], radius: 8, sides: 64}, widen: across}
features:
  1-2: {faces: plate, normals: [-z, +z], what: [base, shoulder]}
  3: {shaft: shaft, axis: +z, what: round shaft}
  4: {hole: hole, axis: -z, what: round hole}
stable_poses: {on-base: -z}
)";

TEST(PartFileTest, RoundShaftsAndHolesHaveAWallForEachSide) {
  for (const double clearance : {0.0, 0.0005}) {
    const auto part = ParsePart(kRound, clearance);
    const Feature& shaft = *part->FindFeature(FeatureNumber(3));
    EXPECT_EQ(shaft.faces.size(), 64u + 1) << "the sides and the tip, and not the covered end";
    EXPECT_LT((shaft.X_PartFeature.translation() - Vector3(0.005, 0, 0.06)).norm(), 1e-9);
    EXPECT_LT((shaft.X_PartFeature.linear().col(2) - Vector3::UnitZ()).norm(), 1e-9);
    const Feature& hole = *part->FindFeature(FeatureNumber(4));
    ASSERT_EQ(hole.mouths.size(), 1u);
    EXPECT_EQ(hole.walls.size(), 64u + 1) << "the sides and the floor";
    EXPECT_LT((hole.X_PartFeature.translation() - Vector3(-0.01, 0, 0)).norm(), 1e-9);
    EXPECT_EQ(std::ranges::count(hole.walls, true, &Wall::moves_with_clearance), 64);
    const double apothem = (0.008 + clearance) * std::cos(M_PI / 64);
    for (const Wall& wall : hole.walls) {
      const Face& face = part->faces()[wall.face.index()];
      if (!wall.moves_with_clearance) continue;
      const double from_axis = face.normal.dot(Vector3(-0.01, 0, 0)) - face.offset;
      EXPECT_NEAR(from_axis, apothem, 1e-9);
    }
    EXPECT_EQ(part->FindFeature(FeatureNumber(1))->description, "base");
    EXPECT_FALSE(part->FindStablePose("on-base").IsNone());
  }
}

TEST(PartFileTest, RoundSectionsAreRecognized) {
  const auto section = [](int sides, double stretch) {
    geometry::Polygon polygon;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * M_PI * i / sides;
      polygon.emplace_back(0.01 * stretch * std::cos(angle), 0.01 * std::sin(angle));
    }
    return polygon;
  };
  for (const int sides : {16, 32, 100}) {
    ASSERT_TRUE(RadiusOfRound(section(sides, 1)).has_value());
    EXPECT_NEAR(*RadiusOfRound(section(sides, 1)), 0.01, 1e-12);
    EXPECT_FALSE(RadiusOfRound(section(sides, 1.001)).has_value());
  }
  EXPECT_FALSE(RadiusOfRound(section(8, 1)).has_value()) << "an octagon is no circle";
}

// A part is the same whether it is written as boxes, as prisms or as hulls.
TEST(PartFileTest, KindsOfShapesAgree) {
  const auto with_body = [](const std::string& shape) {
    return ParsePart(With("box: [[0, 0, 0], [60, 40, 20]]", shape), 0.001);
  };
  const auto boxes = ParsePart(kFile, 0.001);
  for (const std::string shape :
       {"prism: {outline: [[0, 0], [60, 0], [60, 40], [0, 40]], from: 0, to: 20}",
        "prism: {outline: [[0, 0], [0, 60], [20, 60], [20, 0]], axis: y, from: 0, to: 40}",
        "hull: [[0, 0, 0], [60, 0, 0], [0, 40, 0], [60, 40, 0], [0, 0, 20], [60, 0, 20], "
        "[0, 40, 20], [60, 40, 20], [30, 20, 10]]"}) {
    const auto other = with_body(shape);
    EXPECT_NEAR(other->mass().mass, boxes->mass().mass, 1e-12) << shape;
    EXPECT_LT((other->mass().center - boxes->mass().center).norm(), 1e-12) << shape;
    EXPECT_LT((other->mass().inertia - boxes->mass().inertia).norm(), 1e-15) << shape;
    ASSERT_EQ(other->stable_poses().size(), boxes->stable_poses().size()) << shape;
    for (std::size_t i = 0; i < boxes->stable_poses().size(); ++i) {
      EXPECT_TRUE(other->stable_poses()[i].X_TablePart.isApprox(
          boxes->stable_poses()[i].X_TablePart, 1e-9));
    }
    ASSERT_EQ(other->faces().size(), boxes->faces().size()) << shape;
    for (const Face& face : boxes->faces()) {
      const FaceId id = FindFace(other->faces(), face.normal, face.offset);
      ASSERT_FALSE(id.IsNone()) << shape;
      EXPECT_NEAR(geometry::Area(other->faces()[id.index()].patches), geometry::Area(face.patches),
                  1e-12);
    }
    for (const Feature& feature : boxes->features()) {
      const Feature* same = other->FindFeature(feature.number);
      EXPECT_TRUE(same->X_PartFeature.isApprox(feature.X_PartFeature, 1e-9)) << shape;
      EXPECT_EQ(same->walls.size(), feature.walls.size()) << shape;
    }
  }
}

TEST(PartFileTest, AFileThatIsNotThereIsWrongInput) {
  EXPECT_THROW(LoadPart("no-such-part"), InputError);
}

struct Slip {
  const char* old_text;
  const char* new_text;
  const char* message;
};

TEST(PartFileTest, EachSlipIsNamed) {
  const std::vector<Slip> slips = {
      {"assay-part/1", "assay-part/2", "format"},
      {"initial: BR", "initial: b", "cannot begin a label"},
      {"name: bracket", "name: ''", "the name is empty"},
      {"density: 1000", "density: 0",
       "part.yaml:5:10: 0 kg/m^3 is out of range; allowed: 1 kg/m^3 to 100000 kg/m^3"},
      {"density: 1000", "density: -3", "part.yaml:5:10"},
      {"friction: 0.3", "friction: 0", "part.yaml:6:11"},
      {"friction: 0.3", "frictoin: 0.3", "did you mean 'friction'"},
      {"friction: 0.3\n", "", "missing key 'friction'"},
      {"[60, 40, 20]]", "[0, 40, 20]]", "no length along x"},
      {"[60, 40, 20]]", "[60, -40, 20]]", "no length along y"},
      {"[60, 40, 20]]", "[60, 40, 20], [1, 1, 1]]", "two corners, not 3"},
      {"[60, 40, 20]]", "[60, 40]]", "list"},
      {"[60, 40, 20]]", "[60, 40, 1e9]]", "part.yaml:8"},
      {"color: [1, 0, 0, 1]", "color: [2, 0, 0, 1]", "no part of a color"},
      {"color: [1", "colour: [1", "did you mean 'color'"},
      {"cut_from: body", "cut_from: bdy", "did you mean 'body'"},
      {"[[45, 10, 5], [60", "[[65, 10, 5], [70", "cuts nothing"},
      {"[[45, 10, 5], [60, 30, 15]]", "[[-1, -1, -1], [61, 41, 21]]", "leaves nothing"},
      {"[60, 30, 15]]", "[59.999, 30, 15]]", "too thin"},
      {"widen: [y]", "widen: [w]", "x, y, z"},
      {"face: body", "face: boddy", "did you mean 'body'"},
      {"normal: [0, 0, -1]", "normal: [0, 1, -1]", "no side that looks this way"},
      {"normal: [0, 0, -1]", "normal: [0, 0, 0]", "no usable direction"},
      {"face: body, normal: [0, 0, -1]", "face: lug, normal: [0, 0, -1]", "is covered"},
      {"normal: [0, 0, -1], what", "what", "missing key 'normal'"},
      {"hole: slot", "hole: slit", "did you mean 'slot'"},
      {"hole: slot, axis: [1, 0, 0]", "hole: slot, axis: [0, 1, 0]", "no open mouth"},
      {"hole: slot, axis: [1, 0, 0]", "hole: slot, axis: [-1, 0, 0]", "no open mouth"},
      {"hole: slot, axis", "hole: slot, normal", "unknown key 'normal'"},
      {"hole: slot", "hole: []", "at least one pocket"},
      {"hole: slot", "hole: [slot, slit]", "did you mean 'slot'"},
      {"shaft: lug", "shaft: []", "at least one solid"},
      {"shaft: lug", "shaft: [lug, peg]", "unknown name 'peg'"},
      {"shaft: lug, axis", "rod: lug, axis", "face, a hole or a shaft"},
      {"  3: {", "  2.5: {", "integer"},
      {"  3: {", "  02: {", "feature 2 is given twice"},
      {"upright: [0, 0, -1]", "upright: [0, 1, -1]", "30 degrees"},
      {"upright: [0, 0, -1]", "upright: [0, 0, -1], again: [0, 0.1, -1]",
       "already named 'upright'"},
      {"axis: [0, 0, 1]}", "axis: [0, 0, 1], chamfer: -1}", "-1 mm is out of range"},
      {"axis: [0, 0, 1]}", "axis: [0, 0, 1], chamfer: 10.5}", "leaves nothing of the tip"},
      {"axis: [1, 0, 0]}", "axis: [1, 0, 0], chamfer: 15}",
       "allowed: less than the depth of 15 mm"},
      {"axis: [1, 0, 0]}", "axis: [1, 0, 0], chamfer: 30}", "allowed: 0 mm to 20 mm"},
      {"axis: [1, 0, 0]}", "axis: [1, 0, 0], chamfr: 1}", "did you mean 'chamfer'"},
      {"what: bottom", "chamfer: 1", "unknown key 'chamfer'"},
      {"  1: {face: body, normal: [0, 0, -1], what: bottom}",
       "  1-3: {faces: body, normals: [-z, +x], what: [bottom, front]}", "such as 1-2"},
      {"  1: {face: body, normal: [0, 0, -1], what: bottom}",
       "  1-2: {faces: body, normals: [-z, +x], what: [bottom]}", "1 names of 2 faces"},
      {"normal: [0, 0, -1]", "normal: +w", "+x, -x"},
      {"widen: [y]", "widen: across", "a box is not widened across an axis"},
      {"solids:\n", "solids: {}\nextra:\n", "unknown key 'extra'"},
  };
  for (const Slip& slip : slips) {
    const std::string message = ErrorOf(With(slip.old_text, slip.new_text));
    EXPECT_THAT(message, HasSubstr(slip.message)) << slip.new_text;
    EXPECT_THAT(message, HasSubstr("part.yaml")) << slip.new_text;
  }
  EXPECT_EQ(ErrorOf(kFile), "no error");
}

// A plug in the mouth, or a cap over it, closes a hole.
TEST(PartFileTest, AMouthMustBeOpen) {
  for (const char* box : {"[[55, 8, 4], [60, 20, 16]]", "[[60, 5, 8], [70, 25, 12]]"}) {
    const std::string text = With("pockets:", std::string("  plug: {box: ") + box + "}\npockets:");
    EXPECT_THAT(ErrorOf(text), HasSubstr("no open mouth")) << box;
  }
}

// A hole may open into a wider pocket of the same solid. Its mouth is then in the floor of that
// pocket. A pocket that only touches this floor's plane elsewhere has no mouth there.
TEST(PartFileTest, AHoleMayOpenIntoAWiderOne) {
  const auto with_bore = [](const std::string& bore) {
    return With("  slot: {cut_from: body, box: [[45, 10, 5], [60, 30, 15]], widen: [y]}\n",
                "  slot: {cut_from: body, box: [[45, 10, 5], [60, 30, 15]], widen: [y]}\n"
                "  bore: {cut_from: body, box: " +
                    bore + "}\n");
  };
  const auto as_hole = [](std::string text, const std::string& axis) {
    return text.replace(text.find("hole: slot, axis: [1, 0, 0]"), 27, "hole: bore, axis: " + axis);
  };
  const std::string counterbored = with_bore("[[30, 14, 6], [45, 26, 14]]");
  const auto part = ParsePart(as_hole(counterbored, "+x"), 0.001);
  const Feature& hole = *part->FindFeature(FeatureNumber(3));
  ASSERT_EQ(hole.mouths.size(), 1u);
  EXPECT_NEAR(geometry::Area(hole.mouths[0].outline), 12 * 8 * 1e-6, 1e-12);
  EXPECT_EQ(hole.walls.size(), 5u) << "four sides and the floor";
  EXPECT_LT((hole.X_PartFeature.translation() - Vector3(0.045, 0.02, 0.01)).norm(), 1e-9);
  EXPECT_THAT(ErrorOf(as_hole(counterbored, "-x")), HasSubstr("no open mouth"));
  EXPECT_THAT(ErrorOf(as_hole(with_bore("[[30, 2, 6], [45, 8, 14]]"), "+x")),
              HasSubstr("no open mouth"))
      << "it ends in the plane of the slot's floor, beside the slot";
}

// With a bush in the mouth, the hole is the intersection of slot and bore.
TEST(PartFileTest, AHoleMayGoThroughSeveralSolids) {
  const auto with_bush = [](const std::string& bore, const std::string& hole) {
    std::string text = With("pockets:",
                            "  bush: {box: [[50, 8, 3], [60, 32, 9]]}\npockets:\n"
                            "  bore: {cut_from: bush, box: " +
                                bore + "}");
    return text.replace(text.find("hole: slot"), 10, hole);
  };
  const std::string through = "[[45, 15, 0], [60, 25, 30]]";
  EXPECT_THAT(ErrorOf(with_bush(through, "hole: slot")), HasSubstr("no open mouth"));
  EXPECT_THAT(ErrorOf(with_bush("[[45, 15, 0], [55, 25, 30]]", "hole: [slot, bore]")),
              HasSubstr("no open mouth in common"));
  const auto part = ParsePart(with_bush(through, "hole: [slot, bore]"));
  const Feature& hole = *part->FindFeature(FeatureNumber(3));
  ASSERT_EQ(hole.mouths.size(), 1u);
  EXPECT_NEAR(geometry::Area(hole.mouths[0].outline), 10 * 10 * 1e-6, 1e-12)
      << "y from 15 to 25 of the bore, z from 5 to 15 of the slot";
}

// The lug stands on the body at z = 20.
TEST(PartFileTest, SolidsHangTogether) {
  const auto with_lug = [](const char* lug) {
    return ErrorOf(With("[[20, 10, 20], [40, 30, 50]]", lug));
  };
  EXPECT_EQ(with_lug("[[20, 10, 10], [40, 30, 50]]"), "no error") << "in a volume";
  EXPECT_EQ(with_lug("[[59.9, 10, 20], [90, 30, 50]]"), "no error") << "in a strip of a face";
  EXPECT_THAT(with_lug("[[20, 10, 20.01], [40, 30, 50]]"),
              HasSubstr("part.yaml:9:8: solid 'lug' is not connected to solid 'body', directly or "
                        "through other solids"));
  EXPECT_THAT(with_lug("[[274, 10, 20], [294, 30, 50]]"), HasSubstr("solid 'lug'"));
  EXPECT_THAT(with_lug("[[60, 10, 20], [90, 30, 50]]"), HasSubstr("solid 'lug'")) << "in an edge";
  EXPECT_THAT(with_lug("[[60, 40, 20], [90, 60, 50]]"), HasSubstr("solid 'lug'")) << "in a corner";
}

// A bridge makes one part of two.
TEST(PartFileTest, SolidsHangTogetherByOthers) {
  const std::string apart = With("[[20, 10, 20], [40, 30, 50]]", "[[20, 10, 60], [40, 30, 90]]");
  EXPECT_THAT(ErrorOf(apart), HasSubstr("solid 'lug'"));
  std::string bridged = apart;
  bridged.insert(bridged.find("pockets:"), "  bridge: {box: [[0, 0, 20], [20, 20, 70]]}\n");
  EXPECT_EQ(ErrorOf(bridged), "no error");
}

TEST(PartFileTest, PocketsLeaveSolidsInOnePiece) {
  EXPECT_THAT(ErrorOf(With("[[45, 10, 5], [60, 30, 15]]", "[[10, -1, -1], [15, 41, 21]]")),
              HasSubstr("the pockets cut solid 'body' into unconnected pieces"));
}

// The pieces of the body beside the slot meet at y = 10. A pocket that ends 1 micrometre before
// this seam leaves a thin piece there, but no thin wall.
TEST(PartFileTest, AThinPieceBetweenOthersIsNoWall) {
  const auto with_pocket = [](const std::string& box) {
    return With("features:", "  second: {cut_from: body, box: " + box + "}\nfeatures:");
  };
  const std::string text = with_pocket("[[10, 2, 5], [20, 9.999, 20]]");
  EXPECT_EQ(ErrorOf(text), "no error");
  EXPECT_NEAR(ParsePart(kFile)->mass().mass - ParsePart(text)->mass().mass,
              1000 * 0.01 * 0.007999 * 0.015, 1e-12);
  EXPECT_THAT(ErrorOf(with_pocket("[[35, 12, 5], [44.999, 20, 20]]")), HasSubstr("too thin"))
      << "a wall between two pockets";
}

// The result does not depend on how the whole part is turned.
TEST(PartFileTest, TurnedSolidsHangTogether) {
  for (const char* axis : {"[0, 0, 1]", "[1, 2, 3]", "[-2, 1, 0.3]"}) {
    for (const double angle : {0.0, 12.3, 45.0, 77.0, 100.0}) {
      const auto with_lug = [&](const std::string& lug) {
        std::string text = With("color: [1, 0, 0, 1]}",
                                fmt::format("turn: {{axis: {}, angle: {}}}}}", axis, angle));
        text.replace(text.find("features:"), std::string::npos, "");
        return ErrorOf(
            text.replace(text.find("[[20, 10, 20], [40, 30, 50]]}"), 29,
                         fmt::format("{}, turn: {{axis: {}, angle: {}}}}}", lug, axis, angle)));
      };
      EXPECT_EQ(with_lug("[[20, 10, 20], [40, 30, 50]]"), "no error") << axis << " " << angle;
      EXPECT_THAT(with_lug("[[20, 10, 20.01], [40, 30, 50]]"), HasSubstr("solid 'lug'"));
      EXPECT_THAT(with_lug("[[60, 10, 20], [90, 30, 50]]"), HasSubstr("solid 'lug'"));
    }
  }
}

TEST(PartFileTest, APocketTurnsWithItsSolid) {
  const auto straight = ParsePart(With("stable_poses: {upright: [0, 0, -1]}\n", ""));
  std::string text = With("stable_poses: {upright: [0, 0, -1]}\n", "");
  for (const char* color : {"color: [1, 0, 0, 1]}", "[40, 30, 50]]}"}) {
    std::string turned = color;
    turned.insert(turned.size() - 1, ", turn: {axis: [0, 0, 1], angle: 90, about: [10, 0, 0]}");
    text.replace(text.find(color), std::string(color).size(), turned);
  }
  text.replace(text.find("hole: slot, axis: [1, 0, 0]"), 27, "hole: slot, axis: [0, 1, 0]");
  const auto turned = ParsePart(text);
  const Pose X = geometry::Translation(0.01, 0, 0) * geometry::RotationZ(90 * kDegree) *
                 geometry::Translation(-0.01, 0, 0);
  EXPECT_NEAR(turned->mass().mass, straight->mass().mass, 1e-12);
  EXPECT_LT((turned->mass().center - X * straight->mass().center).norm(), 1e-9);
  for (int feature : {1, 2, 3}) {
    const FeatureNumber number(feature);
    const Pose expected = X * straight->FindFeature(number)->X_PartFeature;
    const Pose actual = turned->FindFeature(number)->X_PartFeature;
    EXPECT_LT((actual.translation() - expected.translation()).norm(), 1e-9) << feature;
    EXPECT_LT((actual.linear().col(2) - expected.linear().col(2)).norm(), 1e-9) << feature;
  }
}

}  // namespace
}  // namespace assay::domain::part_file_test
