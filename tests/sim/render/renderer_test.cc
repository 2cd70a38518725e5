#include "sim/render/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "planner/geometry/pose.h"
#include "sim/render/picture.h"
#include "sim/render/picture_library.h"
#include "sim/scene/scene.h"
#include "tests/sim/scene/peg_and_block.h"

namespace assay::render::renderer_test {
namespace {

using scene::PegAndBlock;
using scene::Scene;

// Renderers of different machines rasterise differently. The figure is out of 255.
constexpr double kMeanDifference = 3;

double MeanDifference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum / static_cast<double>(a.rgb.size());
}

struct Rgb {
  int red = 0;
  int green = 0;
  int blue = 0;
};

// Returns the fraction of the pixels for which `is` holds.
template <class Predicate>
double Fraction(const Image& image, Predicate is) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    if (is(Rgb{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]})) ++count;
  }
  return 3.0 * count / static_cast<double>(image.rgb.size());
}

bool IsBlue(const Rgb& c) { return c.blue > c.red + 60; }                            // the block
bool IsOrange(const Rgb& c) { return c.red > c.blue + 70 && c.red > c.green + 15; }  // the peg

class RendererTest : public testing::Test {
 protected:
  Image Picture(const char* camera, int width, int height) {
    Renderer renderer(scene.model(), width, height);
    return renderer.Render(data, scene.model().Camera(camera));
  }

  Scene scene{PegAndBlock(), {}};
  mujoco::Data data = scene.Start();
};

TEST_F(RendererTest, ThereIsOne) { EXPECT_NE(AvailableRenderer(), ""); }

TEST_F(RendererTest, TheCloseViewShowsBlockAndPeg) {
  const Image image = Picture("close", 320, 240);
  EXPECT_GT(Fraction(image, IsBlue), 0.01);
  EXPECT_GT(Fraction(image, IsOrange), 0.01);
  EXPECT_LT(Fraction(image, IsBlue), 0.3);
}

TEST_F(RendererTest, APartThatIsMovedAwayIsNotInThePicture) {
  scene.SetPart(data, scene::kBlock, geometry::Translation(0.7, 30, 0));
  EXPECT_EQ(Fraction(Picture("close", 160, 120), IsBlue), 0);
}

TEST_F(RendererTest, AllCamerasShowSomethingLit) {
  for (const char* camera : {"overview", "close", "side", "top"}) {
    const Image image = Picture(camera, 160, 120);
    double sum = 0;
    for (const std::uint8_t value : image.rgb) sum += value;
    const double mean = sum / static_cast<double>(image.rgb.size());
    EXPECT_GT(mean, 80) << camera;
    EXPECT_LT(mean, 210) << camera;
    EXPECT_GT(Fraction(image, IsBlue) + Fraction(image, IsOrange), 0.0005) << camera;
  }
}

TEST_F(RendererTest, LooksLikeTheReference) {
  std::ifstream file(ASSAY_SOURCE_DIR "/renders/reference/figure-13-overview.png",
                     std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  const Image reference = Pictures().Decode(bytes).value();
  const Image image = Picture("overview", 320, 240);
  const std::filesystem::path drawn =
      std::filesystem::path(testing::TempDir()) / "figure-13-overview.png";
  std::ofstream(drawn, std::ios::binary) << EncodedPng(image);
  ASSERT_EQ(image.width, reference.width);
  ASSERT_EQ(image.height, reference.height);
  EXPECT_LT(MeanDifference(image, reference), kMeanDifference) << "see " << drawn;
}

TEST_F(RendererTest, TheSameSceneGivesTheSameBytes) {
  Renderer renderer(scene.model(), 200, 150);
  const mujoco::CameraId camera = scene.model().Camera("overview");
  const Image first = renderer.Render(data, camera);
  renderer.Render(data, scene.model().Camera("top"));
  EXPECT_TRUE(renderer.Render(data, camera) == first);
  EXPECT_TRUE(Picture("overview", 200, 150) == first);
}

TEST_F(RendererTest, SizesNeedNotBeRound) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {101, 67}, {33, 500}}) {
    const Image image = Picture("overview", width, height);
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.rgb.size(), std::size_t{3} * width * height);
  }
  // The view is the same for any number of pixels.
  const Image small = Picture("close", 101, 67);
  const Image large = Picture("close", 303, 201);
  EXPECT_NEAR(Fraction(small, IsBlue), Fraction(large, IsBlue), 0.005);
}

TEST_F(RendererTest, TwoRenderersDoNotDisturbEachOther) {
  Renderer first(scene.model(), 120, 90);
  Renderer second(scene.model(), 60, 90);
  const mujoco::CameraId camera = scene.model().Camera("close");
  const Image before = first.Render(data, camera);
  second.Render(data, camera);
  EXPECT_TRUE(first.Render(data, camera) == before);
}

// The free camera has the pose and angle of the model's camera "top".
TEST_F(RendererTest, AFreeCameraSeesWhatACameraOfTheModelSees) {
  const geometry::Vector3 table(0.675, 0, 0);
  const FreeCamera camera{
      geometry::PoseFromColumns({0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {table.x() - 0.05, 0, 2.6}),
      36 * scene::kDegree};
  Renderer renderer(scene.model(), 200, 150);
  const Image expected = renderer.Render(data, scene.model().Camera("top"));
  EXPECT_LT(MeanDifference(renderer.Render(data, camera), expected), 0.1);
  EXPECT_TRUE(renderer.Render(data, scene.model().Camera("top")) == expected);
}

TEST_F(RendererTest, WithoutEffectsTheShapesAreTheSame) {
  Renderer renderer(scene.model(), 320, 240, {.effects = Effects::kNone});
  const mujoco::CameraId camera = scene.model().Camera("close");
  const Image plain = renderer.Render(data, camera);
  EXPECT_TRUE(renderer.Render(data, camera) == plain);
  const Image full = Picture("close", 320, 240);
  EXPECT_FALSE(plain == full) << "there are shadows";
  EXPECT_NEAR(Fraction(plain, IsBlue), Fraction(full, IsBlue), 0.01);
  EXPECT_NEAR(Fraction(plain, IsOrange), Fraction(full, IsOrange), 0.01);
}

// Returns whether a pixel has the colour of predicted sets. A ghost is nearly opaque.
bool IsPredicted(const Rgb& c) {
  const auto [red, green, blue] = kPredicted.Rgb();
  return std::abs(c.red - red) < 26 && std::abs(c.green - green) < 26 &&
         std::abs(c.blue - blue) < 26;
}

class GhostTest : public RendererTest {
 protected:
  Image PictureWith(std::span<const Ghost> ghosts) {
    Renderer renderer(scene.model(), 320, 240);
    return renderer.Render(data, scene.model().Camera("close"), ghosts);
  }
  // Returns the block's ghost with this displacement, in metres.
  Ghost At(const geometry::Vector3& displacement) const {
    const domain::Problem problem = scene::PegAndBlock();
    geometry::Pose pose = scene.TruePose(data, scene::kBlock);
    pose.pretranslate(displacement);
    return GhostOf(*problem.part(scene::kBlock).model, pose, kPredicted);
  }
};

TEST_F(GhostTest, IsSeenBesideThePart) {
  const Ghost ghost = At({0, 0, 0.1});
  const Image with = PictureWith({&ghost, 1});
  const Image without = PictureWith({});
  const double gained = Fraction(with, IsPredicted) - Fraction(without, IsPredicted);
  EXPECT_GT(gained, 0.001);
  EXPECT_LT(gained, 0.02) << "only edges";
  EXPECT_LT(MeanDifference(with, without), 3) << "all else is as it was";
}

TEST_F(GhostTest, IsHiddenBehindWhatIsThere) {
  const Ghost below = At({0, 0, -0.3});
  EXPECT_EQ(MeanDifference(PictureWith({&below, 1}), PictureWith({})), 0) << "under the table";
}

TEST_F(GhostTest, LeavesNothingInTheNextPicture) {
  Renderer renderer(scene.model(), 320, 240);
  const mujoco::CameraId camera = scene.model().Camera("close");
  const Image before = renderer.Render(data, camera);
  const Ghost ghost = At({0, 0, 0.1});
  renderer.Render(data, camera, {&ghost, 1});
  EXPECT_TRUE(renderer.Render(data, camera) == before);
}

TEST_F(GhostTest, MoreThanTheEngineHasRoomForAreLeftOut) {
  const std::vector<Ghost> many(500, At({0, 0, 0.1}));
  EXPECT_GT(Fraction(PictureWith(many), IsPredicted), 0.001);
}

using RendererDeathTest = RendererTest;

TEST_F(RendererDeathTest, RefusesSizesThatCannotBe) {
  EXPECT_DEATH(Renderer(scene.model(), 0, 10), "picture of 0 by 10");
  EXPECT_DEATH(Renderer(scene.model(), 10, 5000), "picture of 10 by 5000");
}

}  // namespace
}  // namespace assay::render::renderer_test
