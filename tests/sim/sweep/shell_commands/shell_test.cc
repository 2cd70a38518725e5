#include "sim/sweep/shell_commands/shell.h"

#include <gtest/gtest.h>

namespace assay::sweep::shell_test {
namespace {

TEST(Shell, WordsAreQuotedWhereTheyNeedIt) {
  EXPECT_EQ(Word("../a-b_1.yaml"), "../a-b_1.yaml");
  EXPECT_EQ(Word("my file"), "'my file'");
  EXPECT_EQ(Word(""), "''");
  EXPECT_EQ(Word("$HOME"), "'$HOME'");
  EXPECT_EQ(Quoted("it's"), "'it'\\''s'");
  EXPECT_EQ(Quoted("a"), "'a'");
}

TEST(CommandLine, HasTheOptionsThatWereAdded) {
  CommandLine line("mate", "a b.yaml");
  line.AddFlag("--json", false);
  line.AddFlag("--tree", true);
  line.Add("--errors", std::string("x=1"));
  line.AddIfGiven("--trial", std::optional<int>());
  line.AddIfGiven("--seed", std::optional(7));
  line.AddUnless(1.5, "--beyond", 1.5);
  line.AddUnless(1.5, "--scale", 0.5);
  EXPECT_EQ(line.text(), "assay mate 'a b.yaml' --tree --errors 'x=1' --seed 7 --scale 0.5");
}

}  // namespace
}  // namespace assay::sweep::shell_test
