#include "sim/mujoco/model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::mujoco::model_test {
namespace {

constexpr char kSlider[] = R"(<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <camera name="eye" pos="0 -1 0"/>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="slider">
      <joint name="x" type="slide" axis="1 0 0"/>
      <joint name="z" type="slide" axis="0 0 1"/>
      <geom name="ball" size="0.1"/>
      <site name="mark"/>
    </body>
  </worldbody>
</mujoco>)";

TEST(Model, FindsThingsByName) {
  const Model model = Model::FromMjcf(kSlider);
  EXPECT_EQ(model.timestep(), 0.001);
  EXPECT_EQ(model.Name(model.Body("slider")), "slider");
  EXPECT_EQ(model.Name(BodyId(0)), "world");
  EXPECT_EQ(model.BodyOf(model.Geom("ball")), model.Body("slider"));
  EXPECT_EQ(model.BodyOf(model.Geom("floor")), BodyId(0));
  EXPECT_EQ(model.QposAddress(model.Joint("z")), 1);
  EXPECT_EQ(model.DofAddress(model.Joint("x")), 0);
  EXPECT_EQ(model.FindCamera("eye"), model.Camera("eye"));
  EXPECT_TRUE(model.FindCamera("ear").IsNone());
}

TEST(Model, SaysWhatTheCompilerDoesNotAccept) {
  try {
    Model::FromMjcf("<mujoco><worldbody><geom size=\"-1\"/></worldbody></mujoco>");
    FAIL() << "compiled";
  } catch (const MjcfError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("size"));
  }
  EXPECT_THROW(Model::FromMjcf("<mujoco><worldbody>"), MjcfError);
  EXPECT_THROW(Model::FromMjcf("<mujoco><nonsense/></mujoco>"), MjcfError);
}

TEST(ModelDeathTest, AbsentNamesAreOurMistake) {
  const Model model = Model::FromMjcf(kSlider);
  EXPECT_DEATH(model.Body("nobody"), "nobody");
}

}  // namespace
}  // namespace assay::mujoco::model_test
