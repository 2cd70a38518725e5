#include "planner/domain/resting/stable_pose_names.h"

namespace assay::domain {

StablePoseNames::StablePoseNames(const PartModel& model) {
  const std::vector<StablePose>& poses = model.stable_poses();
  for (std::size_t i = 0; i < poses.size(); ++i) Add(poses[i].label, StablePoseId(i));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!poses[i].name.empty()) Add(poses[i].name, StablePoseId(i));
  }
}

void StablePoseNames::Add(const std::string& name, StablePoseId pose) {
  names_.push_back(name);
  poses_.push_back(pose);
}

}  // namespace assay::domain
