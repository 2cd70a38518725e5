#include "sim/mujoco/contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::mujoco::contact_test {
namespace {

using geometry::Vector3;

// The slope of 10 degrees gives the contact forces tangential parts. The friction holds the box.
constexpr char kBoxOnSlope[] = R"(<mujoco>
  <option timestep="0.001" cone="elliptic" impratio="10"/>
  <worldbody>
    <geom name="slope" type="box" size="1 1 0.1" pos="0 0 -0.1" friction="0.5"/>
    <body name="box" pos="0 0 0.0499">
      <freejoint/><geom type="box" size="0.05 0.05 0.05" mass="2" friction="0.5"/></body>
  </worldbody>
</mujoco>)";

std::string Sloped() {
  std::string mjcf = kBoxOnSlope;
  const std::string gravity = "gravity=\"1.7034 0 -9.6610\" ";  // 9.81 m/s^2, turned by 10 degrees
  return mjcf.insert(mjcf.find("<option ") + 8, gravity);
}

Vector3 Sum(const std::vector<Contact>& contacts) {
  Vector3 sum = Vector3::Zero();
  for (const Contact& contact : contacts) sum += contact.force_on_b;
  return sum;
}

TEST(Contacts, AtRestTheyCarryTheWeight) {
  const Model model = Model::FromMjcf(Sloped());
  Data data(model);
  for (int i = 0; i < 1000; ++i) data.Step();
  const Vector3 weight = 2 * Vector3(1.7034, 0, -9.6610);
  const auto on_box = ContactsBetween(data, BodyId(0), model.Body("box"));
  ASSERT_GE(on_box.size(), 3u);
  EXPECT_LT((Sum(on_box) + weight).norm(), 1e-3 * weight.norm());
  for (const Contact& contact : on_box) {
    EXPECT_NEAR(contact.normal.z(), 1, 1e-3);
    EXPECT_EQ(contact.body_b, model.Body("box"));
    EXPECT_EQ(contact.geom_a, model.Geom("slope"));
    EXPECT_LE(contact.distance, 0);
  }
}

TEST(Contacts, SwappingTheBodiesTurnsForcesAndNormals) {
  const Model model = Model::FromMjcf(Sloped());
  Data data(model);
  for (int i = 0; i < 100; ++i) data.Step();
  const auto on_box = ContactsBetween(data, BodyId(0), model.Body("box"));
  const auto on_slope = ContactsBetween(data, model.Body("box"), BodyId(0));
  ASSERT_EQ(on_box.size(), on_slope.size());
  for (std::size_t i = 0; i < on_box.size(); ++i) {
    EXPECT_EQ(on_box[i].force_on_b, -on_slope[i].force_on_b);
    EXPECT_EQ(on_box[i].normal, -on_slope[i].normal);
    EXPECT_EQ(on_box[i].geom_a, on_slope[i].geom_b);
  }
  EXPECT_EQ(Contacts(data).size(), on_box.size());
}

// A step shows the forces that Forward computes at its start, and gives the same bits as a step
// that shows nothing.
TEST(Contacts, AStepShowsTheForcesAtItsStart) {
  const Model model = Model::FromMjcf(Sloped());
  Data data(model);
  Data unseen(model);
  Data still(model);
  for (int i = 0; i < 200; ++i) {
    still.Restore(data.Save());
    const std::vector<Contact> expected = Contacts(still);
    std::vector<Contact> seen;
    data.Step([&] { seen = Contacts(data); });
    unseen.Step();
    ASSERT_TRUE(data.Save() == unseen.Save()) << i;
    ASSERT_EQ(seen.size(), expected.size()) << i;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      EXPECT_EQ(seen[k].position, expected[k].position);
      EXPECT_LT((seen[k].force_on_b - expected[k].force_on_b).norm(), 1e-6) << i;
    }
  }
}

}  // namespace
}  // namespace assay::mujoco::contact_test
