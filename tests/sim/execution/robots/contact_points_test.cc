#include <gtest/gtest.h>

#include <map>

#include "sim/execution/robots/execution.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::contact_points_test {
namespace {

// The parts of figure 15 rest on the table while the arm stays at home.
class AtRest : public testing::Test {
 protected:
  AtRest() : data_(scene_.Start()), execution_(problem_, scene_, data_, options_) {
    EXPECT_FALSE(execution_.Stay(0.5));
  }

  const domain::Problem problem_ = Figure15();
  const scene::Scene scene_{problem_, {}};
  const ExecutorOptions options_;
  mujoco::Data data_;
  Execution execution_;
};

// The contact points of a sample are written after the timestep that follows it. No timestep has
// followed the last one.
TEST_F(AtRest, EverySampleButTheLastHasItsPoints) {
  const auto samples = execution_.trace().All<Sample>();
  ASSERT_GT(samples.size(), 20u);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    ASSERT_TRUE(samples[i]->contact_points) << i;
    std::map<std::size_t, int> count;
    for (const ContactPoint& point : *samples[i]->contact_points) {
      ++count[point.pair];
      EXPECT_NEAR(point.normal.norm(), 1, 1e-9);
    }
    EXPECT_EQ(count.size(), samples[i]->snapshot.contacts.size()) << "every pair has points";
  }
}

TEST_F(AtRest, TheForcesCarryTheWeights) {
  const auto samples = execution_.trace().All<Sample>();
  const Sample& sample = *samples[samples.size() - 2];
  for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
    const std::pair<std::string, std::string> pair = {"part/" + problem_.parts[i].name, "world"};
    Vector3 on_table = Vector3::Zero();
    for (const ContactPoint& point : *sample.contact_points) {
      if (sample.snapshot.contacts[point.pair] != pair) continue;
      on_table += point.force;
      EXPECT_NEAR(point.normal.z(), -1, 1e-6) << "from the part to the table";
      EXPECT_NEAR(point.position.z(), 0, 1e-3);
    }
    const double weight = scene::kGravity * scene_.TrueMass(PartId(i));
    EXPECT_NEAR(on_table.z(), -weight, 0.01 * weight) << pair.first;
    EXPECT_LT(on_table.head<2>().norm(), 0.01 * weight);
  }
}

// Samples only look at the simulation.
TEST_F(AtRest, SamplesChangeNothing) {
  mujoco::Data data = scene_.Start();
  const ExecutorOptions without{.sample_rate = 0};
  Execution execution(problem_, scene_, data, without);
  ASSERT_FALSE(execution.Stay(0.5));
  EXPECT_TRUE(data.Save() == data_.Save());
}

}  // namespace
}  // namespace assay::execution::contact_points_test
