#pragma once

#include <vector>

#include "sim/exec/commands/command.h"

namespace assay::exec {

// Where parts are believed to be. It follows the commands and the sensors, never the truth (Spar:
// "the execution module's world model is updated to reflect the changes affected by the action").
class WorldModel {
 public:
  explicit WorldModel(const domain::Problem& problem);

  // Where a part is believed to be while the tool is at X_WorldTool.
  Pose PartPose(PartId part, const Pose& X_WorldTool) const;
  // Of a part that is not held: where it is. Of a held one: where it was taken.
  const Pose& PartPose(PartId part) const { return X_WorldPart_[part.index()]; }
  int part_count() const { return static_cast<int>(X_WorldPart_.size()); }
  PartId held() const { return held_; }  // None: the hand is empty
  const plan::Hold& hold() const { return hold_; }

  void Take(PartId part, const plan::Hold& hold);
  void LetGo(PartId part, const Pose& X_WorldPart);
  // A part that is not held is believed to be elsewhere.
  void Believe(PartId part, const Pose& X_WorldPart);
  // What a command makes the world believe.
  void Foresee(const Command& command);

 private:
  std::vector<Pose> X_WorldPart_;
  PartId held_;
  plan::Hold hold_;
};

}  // namespace assay::exec
