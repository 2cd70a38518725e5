#pragma once

#include <optional>
#include <vector>

#include "planner/domain/reach/reachability.h"

namespace assay::posting {

// Where every part is at one moment of a plan instance, and which choice put it there.
class World {
 public:
  // A choice is a position in the order of execution; kStartChoice: the part is where it was.
  static constexpr int kStartChoice = -1;

  explicit World(const domain::Problem& problem);

  const domain::Pose& X_WorldPart(domain::PartId part) const { return poses_[part.index()]; }
  int choice(domain::PartId part) const { return choices_[part.index()]; }
  bool mated(domain::PartId part) const;  // to any other part, as held or as fixed

  void Take(domain::PartId part);
  void Rest(domain::PartId part, const domain::Pose& X_WorldPart, int choice);
  void Mate(domain::MatingId mating);

  // All parts but those in the hand and `except`.
  std::vector<domain::PlacedPart> Others(domain::PartId part,
                                         domain::PartId except = domain::PartId::None()) const;

 private:
  const domain::Problem* problem_;
  std::vector<domain::Pose> poses_;
  std::vector<int> choices_;
  std::vector<bool> in_hand_;
  std::vector<domain::MatingId> matings_;
};

}  // namespace assay::posting
