#pragma once

#include <compare>
#include <set>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

// A number of a world: the value, or what is just below it (-1) or just above it (1). Between two
// numbers that tell worlds apart all are alike, up to both.
struct Number {
  double value = 0;
  int beside = 0;

  bool operator==(const Number&) const = default;
  auto operator<=>(const Number&) const = default;
};

// By numeric function, the numbers at which what a tree does may change: its marks. They are the
// bounds that are asked or told, carried back through assignments: a mark m of f is one of g at
// m - l and at m - h where f becomes g + [l, h], and at l - m and h - m where it becomes [l, h] -
// g. Then worlds whose numbers lie at the same marks, or between the same ones, take the same steps
// to such worlds again; one number at each mark and one on each side of it stand for all (a
// bisimulation: Milner 1989), and for the ends of what a number may be.
//
// Marks are carried back to a fixed point, as far as numbers can come, and through no more
// assignments than the tree has actions on a way. They are not complete, and numbers are a sample,
// where a sum has several functions, or where they are too many.
class NumberMarks {
 public:
  // Keeps no reference.
  NumberMarks(const GroundTask& task, const PlanTree& tree);

  bool AreComplete() const { return are_complete_; }

  // Numbers that stand for all of the range, its ends among them; none if it is empty.
  std::vector<Number> In(const Range& range, int slot) const;
  // The same of what is between two numbers.
  std::vector<Number> Between(Number low, Number high, int slot) const;
  // The same where both are sums, which are rounded: with the marks that they may be.
  std::vector<Number> BetweenSums(Number low, Number high, int slot) const;

 private:
  // The function of the slot `to` becomes the sum.
  struct Assignment {
    int to = 0;
    Interval added;
    std::vector<std::pair<int, int>> from;  // slots with their signs
  };

  void Use(const GroundTask& task, const GroundQuery& query);
  void Use(const GroundTask& task, const std::vector<GroundEffect>& effects);
  void Use(const GroundTask& task, const GroundChange& change);
  void Use(const GroundTask& task, const Bound& bound);
  void FindReach();
  Interval ReachOf(const Assignment& assignment) const;
  bool AllSumsAreOfOne() const;
  // False if they become too many.
  bool CarryBack(int most_rounds);
  void CarryBack(const Assignment& assignment, double mark,
                 std::set<std::pair<int, double>>& fresh);
  // Whether a mark differs from the value by rounding alone: it stands for both.
  bool IsNearMark(double value, int slot) const;

  std::vector<std::set<double>> marks_;  // by slot
  std::vector<bool> is_asked_;           // by slot, also how precisely it is known
  std::vector<Interval> reach_;          // by slot, what its number may come to be
  std::vector<Assignment> assignments_;
  bool are_complete_ = true;
};

}  // namespace assay::contingent
