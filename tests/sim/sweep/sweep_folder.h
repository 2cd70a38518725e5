#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sim/sweep/grid/sweep_file.h"
#include "tests/scratch_file.h"

namespace assay::sweep {

// A temporary folder for each test, with two scenario files that grids can name.
class SweepFolder : public ::testing::Test {
 protected:
  SweepFolder() {
    std::filesystem::create_directories(folder_);
    Write("a.yaml", "format: assay-scenario/1\n");
    Write("b.yaml", "format: assay-scenario/1\n");
  }
  ~SweepFolder() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  // Reads a sweep file with these lines.
  Sweep Read(const std::string& lines) const {
    return Load(Write("sweep.yaml", "format: assay-sweep/1\n" + lines));
  }

  const std::filesystem::path folder_ =
      ScratchFile(::testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace assay::sweep
