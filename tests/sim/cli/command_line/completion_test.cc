#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/sim/cli/program.h"

// Each shell is run and asked what it completes.
namespace assay::cli::completion_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Completion : public ::testing::Test {
 protected:
  // Returns the completions of the last word in bash.
  Ended InBash(const std::vector<std::string>& words) {
    std::string script = "source " + FileOf("bash") + "; COMP_WORDS=(";
    for (const std::string& word : words) script += " '" + word + "'";
    script += "); COMP_CWORD=" + std::to_string(words.size() - 1) +
              "; _assay; printf '%s\n' \"${COMPREPLY[@]}\"";
    return cli::Run("bash", {"-c", script});
  }
  // Returns the completions at the end of the line in fish.
  Ended InFish(const std::string& line) {
    return cli::Run("fish",
                    {"--no-config", "-c",
                     "source " + FileOf("fish") + "; complete --do-complete '" + line + "'"});
  }
  std::string FileOf(const std::string& shell) {
    const Ended ended = Assay({"completion", shell});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return folder_.Write(shell == "zsh" ? "_assay" : shell, ended.out);
  }

  const Folder folder_;
};

TEST_F(Completion, BashKnowsVerbsFlagsAndValues) {
  EXPECT_EQ(InBash({"assay", "rep"}).out, "replay\nreport\n");
  EXPECT_THAT(InBash({"assay", "sweep", "sh"}).out, HasSubstr("show"));
  EXPECT_EQ(InBash({"assay", "plan", "--expl"}).out, "--explain\n");
  EXPECT_EQ(InBash({"assay", "run", "--noise", "vert"}).out, "vertices\n");
  EXPECT_EQ(InBash({"assay", "export", "--mj"}).out, "--mjcf\n");  // an option of a group
}

TEST_F(Completion, BashOffersFilesWhereAFileMayStand) {
  const std::string file = folder_.Write("scenario.yaml", "");
  EXPECT_EQ(InBash({"assay", "plan", file.substr(0, file.size() - 3)}).out, file + "\n");
  EXPECT_EQ(InBash({"assay", "plan", "-o", file.substr(0, file.size() - 3)}).out, file + "\n");
}

TEST_F(Completion, FishKnowsVerbsFlagsAndValues) {
  EXPECT_THAT(InFish("assay rep").out, HasSubstr("replay\truns one trial"));
  EXPECT_THAT(InFish("assay sweep sh").out, HasSubstr("show\t"));
  EXPECT_THAT(InFish("assay plan --expl").out, HasSubstr("--explain\t"));
  EXPECT_THAT(InFish("assay run --expl").out, Not(HasSubstr("--explain")));
  EXPECT_THAT(InFish("assay run --noise vert").out, HasSubstr("vertices"));
}

// Zsh accepts the file as the completion of assay, and finds no fault in its functions.
TEST_F(Completion, ZshFindsTheFile) {
  const Ended ended =
      cli::Run("zsh", {"-fc",
                       "fpath=(${1:h} $fpath); autoload -U compinit; compinit -D -u; "
                       "print $_comps[assay]; autoload +X _assay; print $functions[_assay]",
                       "zsh", FileOf("zsh")});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "");
  EXPECT_THAT(ended.out, HasSubstr("_assay\n"));
  EXPECT_THAT(ended.out, HasSubstr("--explain[instead of printing the plan"));
}

TEST_F(Completion, NoOtherShells) {
  const Ended ended = Assay({"completion", "csh"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("bash"));
}

}  // namespace
}  // namespace assay::cli::completion_test
