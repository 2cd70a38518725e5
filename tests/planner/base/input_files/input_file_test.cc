#include "planner/base/input_files/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "tests/scratch_file.h"

namespace assay::input_file_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

fs::path Written(const std::string& name, const std::string& text) {
  fs::remove(ScratchFile(name));
  std::ofstream(ScratchFile(name), std::ios::binary) << text;
  return ScratchFile(name);
}

std::string MessageOf(const fs::path& file, std::size_t most = kMostInputBytes) {
  try {
    ReadInput(file, "a text", most);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(InputFile, IsReadByteForByte) {
  const std::string bytes("\xef\xbb\xbf\0\r\n\xff", 7);
  EXPECT_EQ(ReadInput(Written("bytes", bytes), "bytes"), bytes);
}

TEST(InputFile, IsKnownByEveryPathAndLink) {
  const fs::path file = Written("read", "1");
  const fs::path other = Written("other", "1");
  EXPECT_FALSE(IsInput(file));
  ReadInput(file, "a text");
  const fs::path link = ScratchFile("symbolic");
  const fs::path hard = ScratchFile("hard");
  fs::create_symlink(file, link);
  fs::create_hard_link(file, hard);
  fs::create_directories(ScratchFile("folder"));
  for (const fs::path& path :
       {file, link, hard, ScratchFile("folder") / ".." / "read", fs::relative(file)}) {
    EXPECT_TRUE(IsInput(path)) << path;
  }
  EXPECT_FALSE(IsInput(other));
  EXPECT_FALSE(IsInput(ScratchFile("not there")));
}

// Editors replace a file by a new one when they save it.
TEST(InputFile, IsKnownByItsPathAfterItWasReplaced) {
  const fs::path file = Written("replaced", "1");
  ReadInput(file, "a text");
  fs::rename(Written("new", "2"), file);
  EXPECT_TRUE(IsInput(file));
}

TEST(InputFile, DevicesAreNone) {
  ReadInput("/dev/null", "a text");
  EXPECT_FALSE(IsInput("/dev/null"));
}

TEST(InputFile, IsLimited) {
  EXPECT_EQ(MessageOf(Written("ten", std::string(10, 'a')), 10), "no error");
  EXPECT_THAT(MessageOf(Written("eleven", std::string(11, 'a')), 10), HasSubstr("too large"));
  EXPECT_THAT(MessageOf("/dev/zero"), HasSubstr("too large"));
  EXPECT_THAT(MessageOf("/dev/zero", std::size_t{1} << 40), HasSubstr("8388608 bytes"));
}

TEST(InputFile, NearestNameIsTold) {
  Written("spar-fig13.yaml", "1");
  EXPECT_THAT(MessageOf(ScratchFile("spar-fg13.yaml")),
              HasSubstr("no such file; did you mean 'spar-fig13.yaml'?"));
  EXPECT_THAT(MessageOf(ScratchFile("nothing like it")), Not(HasSubstr("did you mean")));
  EXPECT_THAT(MessageOf(ScratchFile("")), HasSubstr("is a directory"));
}

TEST(Text, ItsFirstWrongByteIsTold) {
  EXPECT_NO_THROW(RequireText("a\tb\r\nä", "f"));
  try {
    RequireText("a\nbä\xff", "f");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().Text(), "f:2:4");
    EXPECT_THAT(error.what(), HasSubstr("0xff"));
  }
}

// Returns the digest of reading these files, each with its text.
std::string DigestOf(const std::vector<std::pair<std::string, std::string>>& files) {
  const FilesRead read;
  for (const auto& [name, text] : files) ReadInput(Written(name, text), "a text");
  return read.Digest();
}

TEST(FilesRead, DigestIsOfAllNamesAndContents) {
  const std::string one = DigestOf({{"digested", "1"}});
  EXPECT_EQ(DigestOf({{"digested", "1"}}), one);
  EXPECT_EQ(DigestOf({{"digested", "1"}, {"digested", "1"}}), one);
  EXPECT_NE(DigestOf({{"digested", "2"}}), one);
  EXPECT_NE(DigestOf({{"digested too", "1"}}), one);
  EXPECT_NE(DigestOf({}), one);
  EXPECT_EQ(DigestOf({{"digested", "1"}, {"digested too", "2"}}),
            DigestOf({{"digested too", "2"}, {"digested", "1"}}));
}

TEST(FilesRead, AreThoseOfItsThreadWhileItLives) {
  const FilesRead outer;
  std::thread([] { ReadInput(Written("digested", "1"), "a text"); }).join();
  EXPECT_EQ(outer.Digest(), DigestOf({}));
  const std::string inner = DigestOf({{"digested", "1"}});
  EXPECT_EQ(outer.Digest(), inner);
  EXPECT_EQ(DigestOf({}), FilesRead().Digest());
}

}  // namespace
}  // namespace assay::input_file_test
