#include "planner/base/input_files/input_error.h"

#include <gtest/gtest.h>

#include <exception>
#include <type_traits>

namespace assay::input_error_test {
namespace {

TEST(InputErrorTest, NamesPlaceFaultAndWhatIsAllowed) {
  const FilePlace place{.file = "scenario.yaml", .line = 7, .column = 3};
  const InputError error(place, "unknown key 'gaol'", "format, goal");
  EXPECT_STREQ(error.what(), "scenario.yaml:7:3: unknown key 'gaol'; allowed: format, goal");
  EXPECT_EQ(error.place().file, "scenario.yaml");
  EXPECT_EQ(error.place().line, 7);
  EXPECT_EQ(error.place().column, 3);
}

TEST(InputErrorTest, LeavesOutWhatIsNotThere) {
  EXPECT_STREQ(InputError({.file = "a.yaml"}, "no such file", "").what(), "a.yaml: no such file");
  EXPECT_STREQ(InputError({.file = "a.yaml", .line = 1, .column = 1}, "empty", "").what(),
               "a.yaml:1:1: empty");
}

TEST(InputErrorTest, IsAnExceptionWithAMessage) {
  try {
    throw InputError({.file = "a.yaml"}, "bad", "good");
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(), "a.yaml: bad; allowed: good");
  }
}

TEST(InputErrorTest, IsNotAnEnvironmentError) {
  EXPECT_FALSE((std::is_base_of_v<EnvironmentError, InputError>));
  EXPECT_FALSE((std::is_base_of_v<InputError, EnvironmentError>));
}

}  // namespace
}  // namespace assay::input_error_test
