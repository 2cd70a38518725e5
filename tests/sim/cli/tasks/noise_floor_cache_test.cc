#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/sim/cli/program.h"

namespace assay::cli::noise_floor_cache_test {
namespace {

namespace fs = std::filesystem;
using ::testing::SizeIs;

// Returns the result of one trial with the cache in this folder.
nlohmann::json TrialWith(const std::string& cache, const std::string& scenario) {
  ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  nlohmann::json result =
      Assay({"run", scenario, "--noise", "uniform", "--trials", "1", "--trial", "1", "--json"})
          .Json();
  result.erase("seconds");
  return result;
}

std::vector<fs::path> KeptIn(const std::string& cache) {
  std::vector<fs::path> files;
  const fs::path folder = fs::path(cache) / "assay" / "noise-floor";
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

TEST(NoiseFloorCache, KeepsWhatWasMeasured) {
  const Folder folder;
  const std::string cache = folder / "cache";
  const std::string scenario = folder.Write("scenario.yaml", TextOf(kTwoActions));
  const nlohmann::json measured = TrialWith(cache, scenario);
  ASSERT_THAT(KeptIn(cache), SizeIs(1));
  const fs::path file = KeptIn(cache).front();
  const std::string kept = TextOf(file);

  // A changed file changes the result, so the file is read.
  nlohmann::json floor = JsonOf(file);
  floor[0][2] = 0.25;  // penetration, metres
  std::ofstream(file) << floor;
  nlohmann::json told = TrialWith(cache, scenario);
  EXPECT_NE(told["gate"].dump().find("0.25"), std::string::npos);

  // A broken file is measured again and repaired.
  std::ofstream(file) << kept.substr(0, kept.size() / 2);
  EXPECT_EQ(TrialWith(cache, scenario), measured);
  EXPECT_EQ(TextOf(file), kept);

  // Another scenario has its own noise floor.
  folder.Write("scenario.yaml", TextOf(kTwoActions) + "simulation: {timestep: 0.001}\n");
  TrialWith(cache, scenario);
  EXPECT_THAT(KeptIn(cache), SizeIs(2));
}

}  // namespace
}  // namespace assay::cli::noise_floor_cache_test
