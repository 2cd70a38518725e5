#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "tests/sim/cli/program.h"

namespace assay::cli::progress_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Runs the program in a terminal of its own, and returns what is written there.
std::string InTerminal(std::vector<std::string> words) {
  words.insert(words.begin(), ASSAY_PROGRAM);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  int terminal = -1;
  const pid_t process = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (process == 0) {
    execv(argv.front(), argv.data());
    _exit(1);
  }
  std::string text;
  std::array<char, 4096> read_now{};
  for (ssize_t count = 0; (count = read(terminal, read_now.data(), read_now.size())) > 0;) {
    text.append(read_now.data(), static_cast<std::size_t>(count));
  }
  close(terminal);
  waitpid(process, nullptr, 0);
  return text;
}

// Measuring takes some tenths of a second for each placement.
const std::vector<std::string> kSomeSeconds = {"calibrate", kTwoLooks, "--trials", "12"};

TEST(Progress, TellsRateAndTimeLeftOnATerminal) {
  const std::string text = InTerminal(kSomeSeconds);
  EXPECT_THAT(text, ContainsRegex("measuring parts, [0-9]+ of 12 placements \\([0-9]+ s, "
                                  "[0-9.]+(/s| s each), [0-9]+ s left\\)"));
  // The line is wiped.
  EXPECT_THAT(text, HasSubstr("\r\033[K"));
}

// Short work has no lines between its results, wherever they go.
TEST(Progress, IsSilentElsewhereForSomeSeconds) {
  EXPECT_THAT(Assay({"calibrate", kTwoLooks, "--trials", "1"}).err, IsEmpty());
}

}  // namespace
}  // namespace assay::cli::progress_test
