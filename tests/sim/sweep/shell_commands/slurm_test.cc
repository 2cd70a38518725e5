#include "sim/sweep/shell_commands/slurm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::sweep::slurm_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(SlurmScript, HasATaskForEachShardAndTellsHowToMerge) {
  const std::string script = SlurmScript({.program = "/opt/assay",
                                          .sweep = "/data/it's.yaml",
                                          .database = "/data/out.sqlite",
                                          .models = "",
                                          .tasks = 3,
                                          .jobs = 2});
  EXPECT_THAT(script, StartsWith("#!/bin/sh\n"));
  EXPECT_THAT(script, HasSubstr("\n#SBATCH --array=1-3\n"));
  EXPECT_THAT(script, HasSubstr("\n#SBATCH --cpus-per-task=2\n"));
  EXPECT_THAT(script, HasSubstr("--shard \"$shard/3\""));
  EXPECT_THAT(script, HasSubstr("'/data/it'\\''s.yaml'"));
  EXPECT_THAT(script, HasSubstr("out-1.sqlite"));
  EXPECT_THAT(script, HasSubstr("out-3.sqlite"));
}

TEST(SlurmScript, ShardsHaveTheirOwnDatabases) {
  EXPECT_EQ(ShardDatabase("a/b.sqlite", "2"), "a/b-2.sqlite");
  EXPECT_EQ(ShardDatabase("b", "7"), "b-7");
}

}  // namespace
}  // namespace assay::sweep::slurm_test
