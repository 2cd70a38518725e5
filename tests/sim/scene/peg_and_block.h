#pragma once

#include <numbers>
#include <string>

#include "planner/base/check.h"
#include "planner/domain/parts/part_file.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/workcell/workcell_file.h"

namespace assay::scene {

constexpr double kInch = 0.0254;
constexpr double kDegree = std::numbers::pi / 180;

// The model and the resting place of a part in a test's problem.
struct Resting {
  std::string model;
  std::string stable_pose;
  double x = 0;    // metres
  double y = 0;    // metres
  double yaw = 0;  // radians
};

inline std::filesystem::path ModelsFolder() { return ASSAY_SOURCE_DIR "/models"; }

inline domain::Part PartAt(const Resting& resting, double clearance) {
  domain::Part part;
  part.name = resting.model;
  part.model =
      domain::PartFile::Load(ModelsFolder() / "parts" / resting.model / "part.yaml", clearance);
  part.resting = part.model->FindStablePose(resting.stable_pose);
  ASSAY_CHECK(!part.resting.IsNone(), "no stable pose {}", resting.stable_pose);
  const domain::Placement placement{resting.x, resting.y, resting.yaw};
  part.X_WorldPart =
      placement.X_WorldTable() * part.model->stable_poses()[part.resting.index()].X_TablePart;
  return part;
}

inline domain::Problem ProblemWith(const std::vector<Resting>& restings) {
  domain::Problem problem;
  problem.name = "test";
  problem.workcell =
      domain::WorkcellFile::Read(ModelsFolder() / "workcells/puma762-table/workcell.yaml");
  problem.clearance = 0.0005;
  for (const Resting& resting : restings) {
    problem.parts.push_back(PartAt(resting, problem.clearance));
  }
  return problem;
}

constexpr domain::PartId kBlock(0);
constexpr domain::PartId kPeg(1);

// Returns the start of Spar's figure 13: the block lies face down and the peg on its side.
inline domain::Problem PegAndBlock() {
  return ProblemWith({{"block", "face-down", 22 * kInch, 6 * kInch, 30 * kDegree},
                      {"peg", "on-side", 20 * kInch, -8 * kInch, -20 * kDegree}});
}

}  // namespace assay::scene
