#pragma once

#include <vector>

#include "sim/execution/commands/command.h"

namespace assay::execution {

// The believed poses of the parts. They follow the commands and the sensors, never the truth (Spar:
// "the execution module's world model is updated to reflect the changes affected by the action").
class WorldModel {
 public:
  explicit WorldModel(const domain::Problem& problem);

  // Returns the part's believed pose while the tool is at X_WorldTool.
  Pose PartPose(PartId part, const Pose& X_WorldTool) const;
  // Returns the believed pose of a part that is not held. For a held part, it is the pose where it
  // was picked up.
  const Pose& PartPose(PartId part) const { return X_WorldPart_[part.index()]; }
  int part_count() const { return static_cast<int>(X_WorldPart_.size()); }
  PartId held() const { return held_; }  // None if the hand is empty
  const plan::Hold& hold() const { return hold_; }

  void Take(PartId part, const plan::Hold& hold);
  void LetGo(PartId part, const Pose& X_WorldPart);
  // Sets the believed pose of a part that is not held.
  void Believe(PartId part, const Pose& X_WorldPart);
  // Updates the poses by what a command should do.
  void Foresee(const Command& command);

 private:
  std::vector<Pose> X_WorldPart_;
  PartId held_;
  plan::Hold hold_;
};

}  // namespace assay::execution
