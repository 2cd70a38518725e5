#pragma once

#include <memory>
#include <optional>
#include <queue>
#include <vector>

#include "planner/finemotion/search/known_beliefs.h"
#include "planner/finemotion/search/starts.h"

namespace assay::finemotion {

// From a start, the maneuvers by which the tip comes in.
struct Sequence {
  Start start;
  std::vector<Maneuver> maneuvers;
};

// What sequences are searched for with.
struct SequenceProblem {
  const Passage& passage;
  const std::vector<Maneuvering>& maneuvering;  // at each critical point
  const StrategyOptions& options;
  double multiple = 1;  // of the starts' errors
};

// An A* search over beliefs, with the three costs of Dakin and Popplestone (sections 2 and 4).
// Starts are drawn first.
class SequenceSearch {
 public:
  enum class Effort {
    kGuided,    // cheap sequences first, for a budget of nodes
    kThorough,  // all of them, but for their costs and for beliefs like known ones
  };
  SequenceSearch(const SequenceProblem& problem, Starts& starts, Effort effort);

  // That is certain to first order; none: there are no more, or the budget is spent.
  std::optional<Sequence> Next();

  bool has_looked_through_all() const { return open_.empty(); }
  int expanded() const { return expanded_; }
  const TestComparison& comparison() const { return comparison_; }
  // Of the refused maneuvers, what was unwanted in that from the node nearest to the goal.
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
  double GuidanceOf(const Node& node) const;
  static Sequence SequenceTo(const NodePointer& goal);

  SequenceProblem problem_;
  Effort effort_;
  std::priority_queue<NodePointer, std::vector<NodePointer>, IsLater> open_;
  KnownBeliefs known_;
  std::optional<Unwanted> refused_ = {};
  double refused_guidance_ = 0;  // of the node that it is refused from
  TestComparison comparison_ = {};
  int expanded_ = 0;
  int made_ = 0;
};

}  // namespace assay::finemotion
