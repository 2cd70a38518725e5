#pragma once

#include <compare>
#include <set>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

// A number in a world: `value` itself, a number just below it (-1) or a number just above it (1).
// All numbers between two neighbouring marks are equivalent.
struct Number {
  double value = 0;
  int beside = 0;

  bool operator==(const Number&) const = default;
  auto operator<=>(const Number&) const = default;
};

// The marks of each numeric function. A mark is a number at which the behaviour of a plan tree may
// change. Marks are the bounds that are asked or asserted, carried back through assignments. A mark
// m of f gives marks of g at m - l and at m - h where f becomes g + [l, h], and at l - m and h - m
// where f becomes [l, h] - g. Two worlds whose numbers lie at the same marks, or between the same
// marks, take the same steps to worlds of the same kind. So one number at each mark and one on each
// side of it represent all numbers (a bisimulation: Milner 1989), including the ends of an
// interval.
//
// Marks are carried back to a fixed point within the reach of the numbers, through at most as many
// assignments as the tree's longest way has actions. If a sum has several functions, or if there
// would be too many marks, the marks are not complete, and numbers are only a sample.
class NumberMarks {
 public:
  // Keeps no reference.
  NumberMarks(const GroundTask& task, const PlanTree& tree);

  bool AreComplete() const { return are_complete_; }

  // Returns numbers that represent the whole range, including its ends. Returns none for an empty
  // range.
  std::vector<Number> In(const Range& range, int slot) const;
  // Returns numbers that represent all numbers from `low` to `high`.
  std::vector<Number> Between(Number low, Number high, int slot) const;
  // Returns the same as Between for two rounded sums. The interval is widened to include marks that
  // may equal an exact sum.
  std::vector<Number> BetweenSums(Number low, Number high, int slot) const;

 private:
  // The assignment of a sum to the function of the slot `to`.
  struct Assignment {
    int to = 0;
    Interval added;
    // slots of the added functions with their signs, +1 or -1
    std::vector<std::pair<int, int>> from;
  };

  void Use(const GroundTask& task, const GroundQuery& query);
  void Use(const GroundTask& task, const std::vector<GroundEffect>& effects);
  void Use(const GroundTask& task, const GroundChange& change);
  void Use(const GroundTask& task, const Bound& bound);
  void FindReach();
  Interval ReachOf(const Assignment& assignment) const;
  bool AllSumsAreOfOne() const;
  // Carries marks back for at most this number of rounds. Returns false if there are too many
  // marks.
  bool CarryBack(int most_rounds);
  void CarryBack(const Assignment& assignment, double mark,
                 std::set<std::pair<int, double>>& fresh);
  // Returns true if a mark differs from the value by rounding alone. The mark then represents both.
  bool IsNearMark(double value, int slot) const;

  std::vector<std::set<double>> marks_;  // indexed by slot
  // indexed by slot: true if a query asks how precisely the number is known
  std::vector<bool> is_asked_;
  // indexed by slot: the interval of numbers that the function may come to have
  std::vector<Interval> reach_;
  std::vector<Assignment> assignments_;
  bool are_complete_ = true;
};

}  // namespace assay::contingent
