#include "sim/sweep/run/shell.h"

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

}  // namespace
}  // namespace assay::sweep::shell_test
