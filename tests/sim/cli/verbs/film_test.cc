#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/sim/cli/program.h"

namespace assay::cli::film_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Films an input into a file with few and small pictures.
Ended Film(const std::string& film, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "film");
  for (const char* word : {"--size", "160x120", "--samples", "1", "--rate", "2", "--speed", "20"}) {
    arguments.push_back(word);
  }
  arguments.insert(arguments.end(), {"-o", film});
  return Assay(arguments);
}

TEST(FilmTest, ShowsATraceWithFewPicturesFromAnyCamera) {
  const Folder folder;
  ASSERT_EQ(Assay({"run", kTwoActions, "-o", folder / "out"}).code, 0);
  const std::string film = folder / "film.webp";
  const std::string trace = folder / "out/trace.jsonl";
  const Ended nowhere = Film(film, {trace, "--camera", "nowhere"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("allowed: work, "));
  EXPECT_FALSE(std::filesystem::exists(film));
  std::string first;
  for (const char* camera : {"work", "close"}) {
    const Ended ended = Film(film, {trace, "--camera", camera});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(film + ": "));
    EXPECT_THAT(TextOf(film), StartsWith("RIFF"));
    EXPECT_NE(TextOf(film), first);
    first = TextOf(film);
  }
}

TEST(FilmTest, ShowsATrialOfAResult) {
  const Folder folder;
  ASSERT_EQ(Assay({"run", kTwoActions, "--noise", "uniform", "-o", folder / "out"}).code, 0);
  const std::string film = folder / "film.webp";
  const Ended ended = Film(film, {folder / "out/result.json", "1"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(TextOf(film), StartsWith("RIFF"));
  const Ended missing = Film(film, {folder / "out/result.json", "2"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("film: "));
  EXPECT_THAT(missing.err, HasSubstr("has no trial 2"));
}

TEST(FilmTest, ShowsAWalkThroughAPlanTree) {
  const Folder folder;
  const std::string film = folder / "film.webp";
  const Ended ended = Film(film, {kTree / "scenarios/bottles.yaml", "2", "--worlds", "all"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(TextOf(film), StartsWith("RIFF"));
}

// What was drawn until then is kept, as a whole film.
TEST(FilmTest, KeepsWhatWasDrawnBeforeAnInterruption) {
  const Folder folder;
  const std::string film = folder / "film.webp";
  Running program({"film", kTwoActions, "-o", film, "--rate", "50"});
  for (int i = 0; i < 60000 && !program.Catches(SIGINT); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  program.Signal(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_THAT(ended.out, StartsWith("interrupted: "));
  EXPECT_THAT(TextOf(film), StartsWith("RIFF"));
}

TEST(FilmTest, RefusesWhatItCannotFilm) {
  const Folder folder;
  const std::string film = folder / "film.webp";
  const Ended gif = Assay({"film", kTwoActions, "-o", folder / "film.gif"});
  EXPECT_EQ(gif.code, 2);
  EXPECT_THAT(gif.err, HasSubstr(".webp or .mp4"));
  EXPECT_EQ(Assay({"film", kTwoActions, "-o", film, "--size", "160x10"}).code, 2);
  EXPECT_EQ(Assay({"film", kTwoActions, "-o", film, "--speed", "0"}).code, 2);
  EXPECT_EQ(Assay({"film", folder / "no.yaml", "-o", film}).code, 3);
  const Ended numbered = Assay({"film", kTwoActions, "1", "-o", film});
  EXPECT_EQ(numbered.code, 2);
  EXPECT_THAT(numbered.err, HasSubstr("film: numbers of trials are for databases"));
  const Ended none = Assay({"film", kImpossible, "-o", film});
  EXPECT_EQ(none.code, 10);
  EXPECT_THAT(none.out, HasSubstr("block starts face-down"));
  EXPECT_FALSE(std::filesystem::exists(film));
}

}  // namespace
}  // namespace assay::cli::film_test
