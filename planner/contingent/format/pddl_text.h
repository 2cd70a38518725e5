#pragma once

#include <string>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

struct PddlFiles {
  std::string domain;
  std::string problem;
};

// The ground task as contingent PDDL, in the fragment that ReadPddlDomain reads: atoms are
// predicates without arguments, K of a literal is the literal, add(Kw, a) is :observe, Kx is oneof,
// what is not known is (unknown a). That something is not known is not asked by preconditions: a
// plan without needless sensing meets them. What is deleted from Kf is false from then on, where
// nothing tells that from being unknown. Throws InputError, at the action, the rule or the goal,
// for what would mean something else: deletions of what is sensed, or asked to be false, or a
// condition of effects; Kw and what is not known in the goal and in conditions of effects;
// intervals, run-time variables, conjunctions in Kw, actions that sense several things, and update
// rules.
PddlFiles ToPddl(const GroundTask& task, const std::string& name);

}  // namespace assay::contingent
