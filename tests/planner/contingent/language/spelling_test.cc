#include "planner/contingent/language/spelling.h"

#include <gtest/gtest.h>

#include "planner/contingent/pks_and_pddl/pks_lexer.h"

namespace assay::contingent::spelling_test {
namespace {

TEST(Spelling, IsANameOfThePksFormat) {
  for (const char* text :
       {"", "-", "a", "A_b-3", "a--b", "-a-", "2nd try?", "2e5", "7", "f(x) = 2.5",
        "\xc3\xbc"
        "ber",
        "# no", "?x", "a\nb", "_"}) {
    const std::string name = Spelled(text);
    const std::vector<Token> tokens = Tokens(name, "names.pks");
    ASSERT_EQ(tokens.size(), 2U) << text;
    EXPECT_TRUE(tokens.front().IsName(name)) << text;
    EXPECT_EQ(Spelled(name), name);
  }
}

TEST(Spelling, KeepsWhatIsAName) {
  for (const char* name : {"a", "A_b-3", "_2nd", "plan1-action_1", "overhead-camera"}) {
    EXPECT_EQ(Spelled(name), name);
  }
}

TEST(Spelling, UniqueNamesAreTakenOnce) {
  std::set<std::string> taken = {"a-2"};
  EXPECT_EQ(Unique("a", taken), "a");
  EXPECT_EQ(Unique("a", taken), "a-3");
  EXPECT_EQ(Unique("b", taken), "b");
  EXPECT_EQ(taken, (std::set<std::string>{"a", "a-2", "a-3", "b"}));
}

}  // namespace
}  // namespace assay::contingent::spelling_test
