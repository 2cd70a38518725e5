#include "sim/noise/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "planner/base/random.h"
#include "tests/sim/noise/figure15_careful.h"

namespace assay::noise::sampling_test {
namespace {

constexpr std::uint64_t kSeed = 7;

// For any two channels, all four combinations of ends are equally frequent among the first points.
TEST(CornerPointTest, AnyTwoChannelsGoTogetherAndAgainstEachOther) {
  for (const int dimensions : {2, 3, 4, 7, 8, 20}) {
    const int count = 2 * static_cast<int>(std::bit_ceil(static_cast<unsigned>(dimensions) + 1));
    for (int a = 0; a < dimensions; ++a) {
      for (int b = a + 1; b < dimensions; ++b) {
        std::map<std::pair<double, double>, int> seen;
        for (int number = 1; number <= count; ++number) {
          const std::vector<double> point = CornerPoint(dimensions, kSeed, number);
          ++seen[{point[a], point[b]}];
        }
        ASSERT_EQ(seen.size(), 4u) << a << " and " << b << " of " << dimensions;
        for (const auto& [corner, times] : seen) ASSERT_EQ(times, count / 4);
      }
    }
  }
}

TEST(CornerPointTest, IsFollowedByItsOpposite) {
  for (int number = 1; number <= 32; number += 2) {
    const std::vector<double> point = CornerPoint(9, kSeed, number);
    const std::vector<double> next = CornerPoint(9, kSeed, number + 1);
    for (std::size_t i = 0; i < point.size(); ++i) EXPECT_EQ(point[i] + next[i], 1);
  }
}

// Every corner of a small box comes in time.
TEST(CornerPointTest, GoesOnAtRandom) {
  std::map<std::vector<double>, int> seen;
  for (int number = 17; number < 17 + 1600; ++number) {
    const std::vector<double> point = CornerPoint(4, kSeed, number);
    for (const double t : point) ASSERT_TRUE(t == 0 || t == 1);
    ++seen[point];
  }
  ASSERT_EQ(seen.size(), 16u);
  for (const auto& [corner, times] : seen) EXPECT_NEAR(times, 100, 50);  // five standard deviations
  EXPECT_NE(CornerPoint(40, kSeed, 1000), CornerPoint(40, kSeed + 1, 1000));
}

// Returns the star discrepancy of points in the unit square by its definition. It is the greatest
// difference of share and area over all boxes from the origin whose opposite corner is on a grid.
double Discrepancy(const std::vector<std::vector<double>>& points) {
  constexpr int kGrid = 50;
  double worst = 0;
  for (int i = 1; i <= kGrid; ++i) {
    for (int j = 1; j <= kGrid; ++j) {
      const double x = static_cast<double>(i) / kGrid;
      const double y = static_cast<double>(j) / kGrid;
      const auto inside = std::ranges::count_if(
          points, [&](const std::vector<double>& p) { return p[0] < x && p[1] < y; });
      const double share = static_cast<double>(inside) / static_cast<double>(points.size());
      worst = std::max(worst, std::abs(share - x * y));
    }
  }
  return worst;
}

TEST(EvenPointTest, FillsTheBoxMoreEvenlyThanChance) {
  double even = 0;
  double random = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream stream(seed, "points");
    std::vector<std::vector<double>> regular, drawn;
    for (int number = 1; number <= 200; ++number) {
      regular.push_back(EvenPoint(2, seed, number));
      drawn.push_back({stream.Uniform(), stream.Uniform()});
    }
    even += Discrepancy(regular);
    random += Discrepancy(drawn);
  }
  EXPECT_LT(even, 0.5 * random);
}

// An additive recurrence with a badly approximable number leaves no gap longer than 3/n among its
// first n values. This holds in each dimension by itself.
TEST(EvenPointTest, IsInTheUnitBoxAndFillsEachEdge) {
  for (const int dimensions : {1, 2, 5, 12, 30}) {
    std::vector<std::vector<double>> edges(dimensions);
    for (int number = 1; number <= 500; ++number) {
      const std::vector<double> point = EvenPoint(dimensions, kSeed, number);
      ASSERT_EQ(point.size(), edges.size());
      for (std::size_t i = 0; i < edges.size(); ++i) {
        ASSERT_GE(point[i], 0);
        ASSERT_LT(point[i], 1);
        edges[i].push_back(point[i]);
      }
    }
    for (std::vector<double>& edge : edges) {
      std::ranges::sort(edge);
      double gap = 1 - edge.back() + edge.front();
      for (std::size_t i = 1; i < edge.size(); ++i) gap = std::max(gap, edge[i] - edge[i - 1]);
      EXPECT_LT(gap, dimensions <= 2 ? 3.0 / 500 : 0.2) << dimensions;
    }
  }
}

// In one dimension, the steps are the golden ratio.
TEST(EvenPointTest, OfOneDimensionIsTheGoldenSequence) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (int number = 1; number < 20; ++number) {
    const double step = EvenPoint(1, kSeed, number + 1)[0] - EvenPoint(1, kSeed, number)[0];
    EXPECT_NEAR(step - std::floor(step), golden, 1e-12);
  }
}

class SampleTest : public testing::Test {
 protected:
  SampleTest() : problem_(Figure15()) {
    problem_.parts[0].error.x = {-0.001, 0.004};
    box_ = ErrorBox(problem_, OneOfEachStep(problem_));
  }

  domain::Problem problem_;
  std::vector<Channel> box_;
};

constexpr Mode kModes[] = {Mode::kNone, Mode::kUniform, Mode::kVertices, Mode::kLowDiscrepancy};

TEST_F(SampleTest, IsInTheBox) {
  for (const Mode mode : kModes) {
    for (int number = 1; number <= 300; ++number) {
      const Noise noise = Sample(problem_, box_, mode, kSeed, number);
      ASSERT_EQ(noise.box(), box_);
      for (std::size_t i = 0; i < box_.size(); ++i) {
        ASSERT_GE(noise.values()[i], box_[i].range.low);
        ASSERT_LE(noise.values()[i], box_[i].range.high);
      }
    }
  }
}

TEST_F(SampleTest, WithoutNoiseIsZero) {
  EXPECT_EQ(Sample(problem_, box_, Mode::kNone, kSeed, 3).values(),
            std::vector<double>(box_.size(), 0));
}

TEST_F(SampleTest, VerticesAreEndsToTheBit) {
  for (int number = 1; number <= 300; ++number) {
    const Noise noise = Sample(problem_, box_, Mode::kVertices, kSeed, number);
    for (std::size_t i = 0; i < box_.size(); ++i) {
      const double value = noise.values()[i];
      ASSERT_TRUE(value == box_[i].range.low || value == box_[i].range.high);
    }
  }
}

// The mean and the variance are those of a uniform distribution.
TEST_F(SampleTest, UniformIsUniform) {
  constexpr int kCount = 2000;
  for (const std::size_t i : {0u, 1u, 9u, 12u}) {
    const Interval& range = box_[i].range;
    const double width = range.high - range.low;
    const double middle = (range.low + range.high) / 2;
    double mean = 0, variance = 0;
    for (int number = 1; number <= kCount; ++number) {
      const double off = Sample(problem_, box_, Mode::kUniform, kSeed, number).values()[i] - middle;
      mean += off / kCount;
      variance += off * off / kCount;
    }
    EXPECT_NEAR(mean / width, 0, 5 * std::sqrt(1.0 / 12 / kCount));
    EXPECT_NEAR(variance / (width * width), 1.0 / 12, 0.01);
  }
}

// Trials may be done in any order and on any machine, so earlier samples must make no difference.
TEST_F(SampleTest, DependsOnNumberAndSeedAlone) {
  for (const Mode mode : kModes) {
    std::vector<std::vector<double>> forward;
    for (int number = 1; number <= 200; ++number) {
      forward.push_back(Sample(problem_, box_, mode, kSeed, number).values());
    }
    for (int number = 200; number >= 1; --number) {
      ASSERT_EQ(Sample(problem_, box_, mode, kSeed, number).values(), forward[number - 1]);
    }
    if (mode == Mode::kNone) continue;
    EXPECT_NE(forward[0], forward[1]);
    EXPECT_NE(Sample(problem_, box_, mode, kSeed + 1, 200).values(), forward[199]);
  }
}

TEST(ModeTest, HasANameEach) {
  ASSERT_EQ(ModeNames().size(), std::size(kModes));
  EXPECT_EQ(Name(Mode::kNone), "none");
  EXPECT_EQ(Name(Mode::kUniform), "uniform");
  EXPECT_EQ(Name(Mode::kVertices), "vertices");
  EXPECT_EQ(Name(Mode::kLowDiscrepancy), "low-discrepancy");
}

}  // namespace
}  // namespace assay::noise::sampling_test
