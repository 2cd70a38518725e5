#pragma once

#include <functional>

#include "planner/motion/paths/joint_path.h"

namespace assay::motion {

using kinematics::JointVector;

// RRT-Connect (Kuffner and LaValle 2000) of OMPL, in a box of six dimensions. OMPL depends on ODE,
// Boost and OctoMap, and most plans need no search. So OMPL is in a module (planner/ompl), which is
// opened when straight paths are not enough.
class TreeSearch {
 public:
  virtual ~TreeSearch() = default;

  struct Problem {
    JointVector lower;  // the box
    JointVector upper;
    JointVector start;
    JointVector goal;
    double longest_motion = 0;          // greatest length of a motion of the trees
    std::function<JointVector()> draw;  // returns a random point of the box
    std::function<bool(const JointVector& from, const JointVector& to)> is_free;
    std::function<bool()> is_over;  // returns whether the budget is spent
  };
  // Returns a path from the start to the goal along free motions. The path is empty if `is_over`
  // ended the search before a path was found.
  virtual JointPath FindPath(const Problem& problem) const = 0;
};

// Returns the search for joint paths: the one instance in the module, which the first call opens.
// Throws EnvironmentError if there is no module, or if a library that it needs is missing.
const TreeSearch& TreeSearchOfOmpl();

}  // namespace assay::motion
