#pragma once

#include <memory>
#include <optional>
#include <queue>
#include <vector>

#include "planner/finemotion/strategy_search/known_poses.h"
#include "planner/finemotion/strategy_search/starts.h"

namespace assay::finemotion {

// A start, and the maneuvers by which the tip enters from there.
struct Sequence {
  Start start;
  std::vector<Maneuver> maneuvers;
};

// The inputs of a search for sequences.
struct SequenceProblem {
  const Passage& passage;
  const std::vector<Maneuvering>& maneuvering;  // one for each critical point
  const StrategyOptions& options;
  double multiple = 1;  // multiple of the starts' errors
};

// An A* search over believed poses, with the three costs of Dakin and Popplestone (sections 2 and
// 4). The constructor draws the starts.
class SequenceSearch {
 public:
  enum class Effort {
    kGuided,  // cheap sequences first, within a budget of nodes
    // Sequences that make the errors small first, within a budget of nodes, with more kinds of
    // maneuvers, and without believed poses like known ones.
    kDiverse,
    kThorough,  // all sequences, whatever their costs, without believed poses like known ones
  };
  SequenceSearch(const SequenceProblem& problem, Starts& starts, Effort effort);

  // Returns the next sequence that is certain to first order, or none if there are no more or the
  // budget is spent.
  std::optional<Sequence> Next();

  bool has_looked_through_all() const { return open_.empty(); }
  int expanded() const { return expanded_; }
  const TestComparison& comparison() const { return comparison_; }
  // Returns the contact or loss for which a maneuver was refused. If several were refused, it is
  // the maneuver from the node nearest to the goal.
  const std::optional<Unwanted>& refused() const { return refused_; }

 private:
  struct Node;
  using NodePointer = std::shared_ptr<const Node>;
  struct IsLater {
    bool operator()(const NodePointer& a, const NodePointer& b) const;
  };

  const Maneuvering& ManeuveringAt(int point) const;
  bool IsLast(int point) const { return point == problem_.passage.critical_points() - 1; }
  bool IsGoal(const Node& node) const;
  int Budget() const;
  void Open(const Start& start, const Starts& starts);
  void Expand(const NodePointer& node);
  void Refuse(const Node& node, const Maneuvered& done);
  NodePointer WithExactCost(Node node);
  Maneuvered Apply(int point, const Situation& situation, const Maneuver& maneuver,
                   Margins margins);
  void Push(Node node);
  std::vector<Maneuver> ManeuversFrom(const Node& node) const;
  double ConfusionOf(const Maneuvered& done) const;
  double Beside(const Node& node) const;
  double ErrorsToReduce(const BelievedPose& believed, const Maneuvering& here) const;
  double GuidanceOf(const Node& node) const;
  static Sequence SequenceTo(const NodePointer& goal);

  SequenceProblem problem_;
  Effort effort_;
  std::priority_queue<NodePointer, std::vector<NodePointer>, IsLater> open_;
  KnownPoses known_;
  std::optional<Unwanted> refused_ = {};
  double refused_guidance_ = 0;  // guidance of the node that `refused_` is from
  TestComparison comparison_ = {};
  int expanded_ = 0;
  int made_ = 0;
};

}  // namespace assay::finemotion
