#pragma once

#include <vector>

#include "sim/exec/command.h"

namespace assay::exec {

// Where parts are believed to be. It follows the commands and never the simulation (Spar: "the
// execution module's world model is updated to reflect the changes affected by the action").
class WorldModel {
 public:
  explicit WorldModel(const domain::Problem& problem);

  // Where a part is believed to be while the tool is at X_WorldTool.
  Pose PartPose(PartId part, const Pose& X_WorldTool) const;
  int part_count() const { return static_cast<int>(X_WorldPart_.size()); }
  PartId held() const { return held_; }  // None: the hand is empty
  const plan::Hold& hold() const { return hold_; }

  void Take(PartId part, const plan::Hold& hold);
  void LetGo(PartId part, const Pose& X_WorldPart);

 private:
  std::vector<Pose> X_WorldPart_;
  PartId held_;
  plan::Hold hold_;
};

}  // namespace assay::exec
