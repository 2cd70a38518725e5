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

TEST(FilmTest, ShowsATraceWithFewPictures) {
  const Folder folder;
  ASSERT_EQ(Assay({"run", kTwoActions, "-o", folder / "out"}).code, 0);
  const std::string film = folder / "film.webp";
  const Ended ended = Assay({"film", folder / "out/trace.jsonl", "-o", film, "--size", "160x120",
                             "--samples", "1", "--rate", "2", "--speed", "10"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr(film + ": "));
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
  const Ended tree = Assay({"film", kTree / "scenarios/two-cans.yaml", "-o", film});
  EXPECT_EQ(tree.code, 2);
  EXPECT_THAT(tree.err, HasSubstr("is a tree"));
  const Ended camera = Assay({"film", kTwoActions, "-o", film, "--camera", "nowhere"});
  EXPECT_EQ(camera.code, 2);
  EXPECT_THAT(camera.err, HasSubstr("allowed: work, "));
  EXPECT_FALSE(std::filesystem::exists(film));
}

}  // namespace
}  // namespace assay::cli::film_test
