#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "planner/kinematics/arm.h"
#include "tests/scratch_file.h"

namespace assay::kinematics {

inline const std::filesystem::path kPuma =
    std::filesystem::path(ASSAY_SOURCE_DIR) / "models/robots/puma762/puma762.urdf";

inline const Arm& Puma() {
  static const Arm arm = Arm::FromUrdf(kPuma);
  return arm;
}

inline std::string PumaText() {
  std::stringstream text;
  text << std::ifstream(kPuma).rdbuf();
  return text.str();
}

inline std::filesystem::path WriteUrdf(const std::string& name, const std::string& text) {
  const std::filesystem::path path = ScratchFile(name);
  std::ofstream(path) << text;
  return path;
}

// Returns the Puma's URDF text with one passage replaced. The passage must be there.
inline std::string PumaWith(const std::string& from, const std::string& to) {
  std::string text = PumaText();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace assay::kinematics
