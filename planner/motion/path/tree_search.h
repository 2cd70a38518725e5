#pragma once

#include <functional>

#include "planner/motion/path/joint_path.h"

namespace assay::motion {

using kinematics::JointVector;

// RRT-Connect (Kuffner and LaValle 2000) as OMPL has it, in a box of six dimensions. OMPL brings
// ODE, Boost and OctoMap, and most plans do without a search. It stands behind a module
// (planner/ompl) that is opened when straight paths do not do.
class TreeSearch {
 public:
  virtual ~TreeSearch() = default;

  struct Problem {
    JointVector lower;  // the box
    JointVector upper;
    JointVector start;
    JointVector goal;
    double longest_motion = 0;          // of the trees
    std::function<JointVector()> draw;  // a point of the box, at random
    std::function<bool(const JointVector& from, const JointVector& to)> is_free;
    std::function<bool()> is_over;  // the budget is spent
  };
  // From the start to the goal, along motions that are free; empty if it was over before.
  virtual JointPath FindPath(const Problem& problem) const = 0;
};

// The module's one instance. Opens the module at the first call. Throws EnvironmentError if there
// is none, or if a library that it needs is missing.
const TreeSearch& TreeSearchOfOmpl();

}  // namespace assay::motion
