#pragma once

#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "planner/domain/reach/known_reachability.h"
#include "planner/posting/step_geometry.h"

namespace assay::posting {

// A set of parts, by their index.
using PartSet = std::vector<bool>;

// What the hand of one robot can do, label by label, with one part, or with the two of one mating;
// and which other parts, as long as they lie where they were at the start, are in its way.
class RelaxedHand {
 public:
  // `problem`: worked by that robot, with the grasps to look at.
  explicit RelaxedHand(domain::Problem problem);
  RelaxedHand(const RelaxedHand&) = delete;
  RelaxedHand& operator=(const RelaxedHand&) = delete;

  const domain::Problem& problem() const { return problem_; }

  // The conditions that fail, other parts left aside.
  domain::GraspConditions Broken(domain::PartId part, int grasp, int position) const;
  domain::GraspConditions BrokenMating(domain::MatingId mating, int grasp, int position) const;

  // Where no condition fails: whether the part can be taken or put down so somewhere, past all
  // parts but those that have moved.
  bool IsFree(domain::PartId part, int grasp, int position, const PartSet& moved) const;
  bool IsMatingFree(domain::MatingId mating, int grasp, int position, const PartSet& moved) const;

 private:
  // By grasp and position.
  struct ConditionTable {
    int positions = 0;
    std::vector<domain::GraspConditions> broken = {};
  };
  template <class BrokenPair>
  static ConditionTable TableOf(const domain::Part& gripped, const domain::Part& placed,
                                const BrokenPair& broken);
  void AddPart(domain::PartId id);
  void AddMating(domain::MatingId id);

  // For each place where it works at all, the parts that are in the way there; none that contain
  // others.
  using Ways = std::vector<PartSet>;
  using Works = std::function<bool(World& world, const domain::Pose& X_WorldPart)>;
  Ways WaysTo(domain::PartId placed, int position, const PartSet& involved,
              const Works& works) const;
  PartSet InTheWay(const domain::Pose& X_WorldPart, const PartSet& involved,
                   const Works& works) const;

  domain::Problem problem_;
  mutable domain::KnownReachability reachability_;
  StepGeometry geometry_;
  std::vector<ConditionTable> parts_;     // by part
  std::vector<ConditionTable> matings_;   // by mating
  using Key = std::tuple<int, int, int>;  // part or mating, grasp, position
  mutable std::map<Key, Ways> ways_;
  mutable std::map<Key, Ways> mating_ways_;
};

// The poses that a position label stands for: that at the start, or the placements of a stable one.
std::vector<domain::Pose> PosesAt(const domain::Problem& problem, domain::PartId part,
                                  int position);

}  // namespace assay::posting
