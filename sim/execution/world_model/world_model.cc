#include "sim/execution/world_model/world_model.h"

namespace assay::execution {

WorldModel::WorldModel(const domain::Problem& problem) {
  for (const domain::Part& part : problem.parts) X_WorldPart_.push_back(part.X_WorldPart);
}

Pose WorldModel::PartPose(PartId part, const Pose& X_WorldTool) const {
  if (part == held_) return X_WorldTool * hold_.X_PartTool.inverse();
  return X_WorldPart_[part.index()];
}

void WorldModel::Take(PartId part, const plan::Hold& hold) {
  held_ = part;
  hold_ = hold;
}

void WorldModel::LetGo(PartId part, const Pose& X_WorldPart) {
  X_WorldPart_[part.index()] = X_WorldPart;
  held_ = PartId::None();
}

void WorldModel::Believe(PartId part, const Pose& X_WorldPart) {
  X_WorldPart_[part.index()] = X_WorldPart;
}

void WorldModel::Foresee(const Command& command) {
  if (const auto* close = std::get_if<CloseGripper>(&command)) Take(close->part, close->hold);
  const auto* open = std::get_if<OpenGripper>(&command);
  if (open != nullptr && open->release) LetGo(open->release->part, open->release->X_WorldPart);
}

}  // namespace assay::execution
