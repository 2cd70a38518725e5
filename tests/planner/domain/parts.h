#pragma once

#include <memory>
#include <string>

#include "planner/base/input_files/document.h"
#include "planner/domain/parts/part_file.h"
#include "planner/domain/parts/part_model.h"
#include "planner/kinematics/grippers/gripper.h"

// The parts and the gripper of this repository, for tests.
namespace assay::domain {

constexpr double kInch = 0.0254;
constexpr double kDegree = 3.14159265358979323846 / 180;

inline std::filesystem::path PartPath(const std::string& name) {
  return std::filesystem::path(ASSAY_SOURCE_DIR) / "models/parts" / name / "part.yaml";
}

inline std::shared_ptr<const PartModel> LoadPart(const std::string& name,
                                                 double clearance = 0.0005) {
  return PartFile::Load(PartPath(name), clearance);
}

inline std::shared_ptr<const PartModel> ParsePart(const std::string& text, double clearance = 0) {
  return PartFile::Read(Document::Parse(text, "part.yaml"), clearance);
}

inline const kinematics::Gripper& ParallelJaw() {
  static const auto gripper = kinematics::Gripper::FromUrdf(
      std::filesystem::path(ASSAY_SOURCE_DIR) / "models/grippers/parallel-jaw/gripper.urdf");
  return gripper;
}

inline const std::vector<std::string>& PartNames() {
  static const std::vector<std::string> names = {
      "block",         "brick",  "keyed-block", "keyed-peg", "octagonal-block",
      "octagonal-peg", "peg",    "round-block", "round-peg", "stepped-block",
      "stepped-peg",   "t-rail", "t-slide",     "twin-block"};
  return names;
}

// Returns a part file with an octagonal shaft through an octagonal flange. Its boxes are at odd
// angles, and its solids overlap.
inline std::string OctagonalPeg() {
  return R"(
format: assay-part/1
name: octagonal-peg
initial: OP
units: {length: mm, angle: degree}
density: 1000
friction: 0.25
solids:
  a: {box: [[0, -20, -8.284271247461902], [60, 20, 8.284271247461902]]}
  b: {box: [[0, -20, -8.284271247461902], [60, 20, 8.284271247461902]], turn: {axis: [1, 0, 0], angle: 45}}
  c: {box: [[0, -20, -8.284271247461902], [60, 20, 8.284271247461902]], turn: {axis: [1, 0, 0], angle: 90}}
  d: {box: [[0, -20, -8.284271247461902], [60, 20, 8.284271247461902]], turn: {axis: [1, 0, 0], angle: 135}}
features:
  7: {shaft: [a, b, c, d], axis: [1, 0, 0], what: octagonal shaft}
)";
}

inline std::vector<int> Indices(const std::vector<FeatureNumber>& numbers) {
  std::vector<int> indices;
  for (FeatureNumber number : numbers) indices.push_back(number.index());
  return indices;
}

}  // namespace assay::domain
