#pragma once

#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "planner/constraint_posting/step_geometry.h"
#include "planner/domain/reachability/known_reachability.h"

namespace assay::constraint_posting {

// A set of parts, by their index.
using PartSet = std::vector<bool>;

// The actions that the hand of one robot can do, label by label, with one part or with the two
// parts of one mating. It includes the other parts that are in the way while they lie where they
// were at the start.
class RelaxedHand {
 public:
  // `problem` has that robot as the acting robot, and the grasps to consider.
  explicit RelaxedHand(domain::Problem problem);
  RelaxedHand(const RelaxedHand&) = delete;
  RelaxedHand& operator=(const RelaxedHand&) = delete;

  const domain::Problem& problem() const { return problem_; }

  // Return the conditions that fail if other parts are ignored.
  domain::GraspConditions Broken(domain::PartId part, int grasp, int position) const;
  domain::GraspConditions BrokenMating(domain::MatingId mating, int grasp, int position) const;

  // Return true if the part can be taken, put down or mated in this way at some place, without
  // meeting any part except those in `moved`. No condition may fail for these labels.
  bool IsFree(domain::PartId part, int grasp, int position, const PartSet& moved) const;
  bool IsMatingFree(domain::MatingId mating, int grasp, int position, const PartSet& moved) const;

 private:
  // the failing conditions, by grasp and position
  struct ConditionTable {
    int positions = 0;
    std::vector<domain::GraspConditions> broken = {};
  };
  template <class BrokenPair>
  static ConditionTable TableOf(const domain::Part& gripped, const domain::Part& placed,
                                const BrokenPair& broken);
  void AddPart(domain::PartId id);
  void AddMating(domain::MatingId id);

  // For each place where the action works, the set of parts that are in the way there. Sets that
  // contain other sets are left out.
  using Ways = std::vector<PartSet>;
  using Works = std::function<bool(World& world, const domain::Pose& X_WorldPart)>;
  Ways WaysTo(domain::PartId placed, int position, const PartSet& involved,
              const Works& works) const;
  PartSet InTheWay(const domain::Pose& X_WorldPart, const PartSet& involved,
                   const Works& works) const;

  domain::Problem problem_;
  mutable domain::KnownReachability reachability_;
  StepGeometry geometry_;
  std::vector<ConditionTable> parts_;     // indexed by part
  std::vector<ConditionTable> matings_;   // indexed by mating
  using Key = std::tuple<int, int, int>;  // part or mating, grasp, position
  mutable std::map<Key, Ways> ways_;
  mutable std::map<Key, Ways> mating_ways_;
};

// Returns the poses of a position label: the pose at the start, or the placements of a stable pose.
std::vector<domain::Pose> PosesAt(const domain::Problem& problem, domain::PartId part,
                                  int position);

}  // namespace assay::constraint_posting
