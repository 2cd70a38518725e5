#include "planner/base/module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/input_files/input_error.h"

namespace assay::module_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string Error(const Module& module) {
  try {
    EntryOf(module);
  } catch (const EnvironmentError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no EnvironmentError";
  return "";
}

TEST(ModuleTest, AMissingOneIsNamedWithItsPackages) {
  EXPECT_THAT(Error({.file = "libassay_nothing.so",
                     .entry = "Nothing",
                     .needed_for = "wishes",
                     .debian_packages = "libwish1 libwell2"}),
              AllOf(StartsWith("wishes need the module libassay_nothing.so: "),
                    HasSubstr("No such file"), EndsWith("; apt-get install libwish1 libwell2")));
}

// A library that every program has takes the place of a module here.
TEST(ModuleTest, OneWithoutTheEntryIsOfAnotherVersion) {
  EXPECT_EQ(Error({.file = "libc.so.6",
                   .entry = "AssayNothing",
                   .needed_for = "wishes",
                   .debian_packages = ""}),
            "libc.so.6 is of another version");
}

TEST(ModuleTest, GivesTheEntry) {
  EXPECT_NE(
      EntryOf(
          {.file = "libc.so.6", .entry = "abort", .needed_for = "wishes", .debian_packages = ""}),
      nullptr);
}

}  // namespace
}  // namespace assay::module_test
