#pragma once

#include <optional>
#include <vector>

#include "planner/domain/actions/action_template.h"
#include "planner/domain/reachability/reachability.h"

namespace assay::constraint_posting {

// The poses of all parts at one time of a plan instance, with the choices that put them there.
class World {
 public:
  // A choice is a position in the order of execution. kStartChoice means that the part has not
  // moved.
  static constexpr int kStartChoice = -1;

  explicit World(const domain::Problem& problem);

  const domain::Pose& X_WorldPart(domain::PartId part) const { return poses_[part.index()]; }
  int choice(domain::PartId part) const { return choices_[part.index()]; }
  // true if the part is mated to any other part, as held or as fixed
  bool mated(domain::PartId part) const;

  // Changes the world as the action does. X_WorldPart is the pose in which the action leaves the
  // part. It is used only if the action leaves the part at a place.
  void Do(const domain::ActionTemplate& action, const domain::Pose& X_WorldPart, int choice);
  void Take(domain::PartId part);
  void Rest(domain::PartId part, const domain::Pose& X_WorldPart, int choice);
  void Mate(domain::MatingId mating);

  // Returns all parts except `part`, `except` and those in the hand.
  std::vector<domain::PlacedPart> Others(domain::PartId part,
                                         domain::PartId except = domain::PartId::None()) const;

 private:
  const domain::Problem* problem_;
  std::vector<domain::Pose> poses_;
  std::vector<int> choices_;
  std::vector<bool> in_hand_;
  std::vector<domain::MatingId> matings_;
};

}  // namespace assay::constraint_posting
