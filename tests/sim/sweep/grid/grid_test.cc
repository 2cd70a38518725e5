#include "sim/sweep/grid/grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "tests/sim/sweep/sweep_folder.h"

namespace assay::sweep::grid_test {
namespace {

class Grid : public SweepFolder {
 protected:
  Sweep Full() const {
    return Read(
        "scenarios: [a.yaml, b.yaml]\n"
        "error_scales: [1, 0.1]\n"
        "propagation: [sound, paper]\n"
        "noise: [none, uniform, vertices]\n"
        "seeds: [4, 5]\n"
        "trials: 10\n"
        "control_trials: 3\n");
  }
};

TEST_F(Grid, HasEveryCombinationOnce) {
  const std::vector<Cell> cells = Cells(Full());
  EXPECT_EQ(cells.size(), 2u * 2 * 2 * 3 * 2);
  std::set<std::tuple<std::string, double, int, int, std::uint64_t>> seen;
  for (const Cell& cell : cells) {
    seen.insert({cell.scenario, cell.error_scale, static_cast<int>(cell.propagation),
                 static_cast<int>(cell.noise), cell.seed});
  }
  EXPECT_EQ(seen.size(), cells.size());
}

TEST_F(Grid, SeedsChangeFastestAndScenariosLast) {
  const std::vector<Cell> cells = Cells(Full());
  EXPECT_EQ(cells[0].seed, 4u);
  EXPECT_EQ(cells[1].seed, 5u);
  EXPECT_EQ(cells[1].noise, NoiseKind::kNone);
  EXPECT_EQ(cells[2].noise, NoiseKind::kUniform);
  EXPECT_EQ(cells.front().scenario, "a.yaml");
  EXPECT_EQ(cells.back().scenario, "b.yaml");
}

// The numbers of the trials go on from cell to cell without a gap.
TEST_F(Grid, TrialsAreNumberedThroughTheCells) {
  const std::vector<Cell> cells = Cells(Full());
  int trial = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i].number, static_cast<int>(i) + 1);
    EXPECT_EQ(cells[i].trials, cells[i].noise == NoiseKind::kNone ? 3 : 10);
    for (int number = 1; number <= cells[i].trials; ++number) {
      const TrialPlace place = PlaceOf(cells, ++trial);
      EXPECT_EQ(place.cell, i);
      EXPECT_EQ(place.number, number);
    }
  }
  EXPECT_EQ(trial, TrialCount(cells));
}

TEST_F(Grid, AFalsificationIsOneTrial) {
  const std::vector<Cell> cells = Cells(
      Read("scenarios: [a.yaml, b.yaml]\nnoise: [attack, uniform]\nseeds: [1, 2]\ntrials: 5\n"));
  ASSERT_EQ(cells.size(), 8u);
  int falsifications = 0;
  for (const Cell& cell : cells) {
    const bool tried = cell.noise == NoiseKind::kFalsification;
    EXPECT_EQ(cell.trials, tried ? 1 : 5);
    EXPECT_EQ(cell.falsification, tried ? ++falsifications : 0);
  }
  EXPECT_EQ(TrialCount(cells), 4 + 4 * 5);
  EXPECT_TRUE(SharePlan(cells[0], cells[2]));
}

// Each shard gets its share of falsifications, even if the trials between the falsifications would
// bring all falsifications to one shard.
TEST_F(Grid, FalsificationsAreDealtOutEvenly) {
  const std::vector<Cell> cells = Cells(Read(
      "scenarios: [a.yaml]\nnoise: [attack, uniform]\nerror_scales: [1, 2, 3, 4]\ntrials: 3\n"));
  for (const int count : {1, 2, 3}) {
    std::vector<int> shares(count);
    for (const Cell& cell : cells) {
      for (int trial = cell.first_trial; trial < cell.first_trial + cell.trials; ++trial) {
        int owners = 0;
        for (int index = 1; index <= count; ++index) {
          const bool has = Shard{index, count}.Has(cell, trial);
          owners += has;
          if (cell.falsification > 0) shares[index - 1] += has;
        }
        EXPECT_EQ(owners, 1);
      }
    }
    const auto [least, most] = std::ranges::minmax(shares);
    EXPECT_LE(most - least, 1);
  }
}

TEST_F(Grid, NoiseDoesNotChangeThePlan) {
  const std::vector<Cell> cells = Cells(Full());
  EXPECT_TRUE(SharePlan(cells[0], cells[5]));
  EXPECT_NE(cells[5].noise, cells[0].noise);
  EXPECT_FALSE(SharePlan(cells[0], cells[6]));
  EXPECT_NE(cells[6].propagation, cells[0].propagation);
}

TEST_F(Grid, ResolversChangeThePlan) {
  const std::vector<Cell> cells = Cells(
      Read("scenarios: [a.yaml]\nresolvers: [[sensing], [fine-motion]]\ngrasp: [weld, friction]\n"
           "trials: 2\n"));
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_EQ(cells[0].resolvers, cells[1].resolvers);
  EXPECT_NE(cells[0].resolvers, cells[2].resolvers);
  EXPECT_EQ(cells[0].grasp, cells[2].grasp);
  EXPECT_FALSE(SharePlan(cells[0], cells[2]));
}

TEST_F(Grid, EveryTrialIsInOneShardAndEveryCellIsCutAlike) {
  const std::vector<Cell> cells = Cells(Full());
  for (const int count : {1, 2, 3, 7}) {
    for (const Cell& cell : cells) {
      std::vector<int> shares(count);
      for (int i = 0; i < cell.trials; ++i) {
        int owners = 0;
        for (int index = 1; index <= count; ++index) {
          const bool has = Shard{index, count}.Has(cell.first_trial + i);
          owners += has;
          shares[index - 1] += has;
        }
        EXPECT_EQ(owners, 1);
      }
      const auto [least, most] = std::ranges::minmax(shares);
      EXPECT_LE(most - least, 1);
    }
  }
}

}  // namespace
}  // namespace assay::sweep::grid_test
