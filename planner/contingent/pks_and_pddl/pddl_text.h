#pragma once

#include <string>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

struct PddlFiles {
  std::string domain;
  std::string problem;
};

// Returns the ground task as contingent PDDL, in the fragment that ReadPddlDomain reads. Atoms
// become predicates without arguments, K of a literal becomes the literal, add(Kw, a) becomes
// :observe, Kx becomes oneof, and an unknown atom becomes (unknown a). PDDL cannot ask that
// something is unknown. The preconditions of actions that only sense lose such conditions; a plan
// without needless sensing meets them. An atom that is deleted from Kf becomes false, provided that
// nothing in the task distinguishes false from unknown.
//
// Throws InputError at the action, the rule or the goal whose PDDL would have another meaning.
// Intervals, run-time variables, update rules, conjunctions in Kw, and actions that sense several
// things have another meaning. The same is true of Kw and conditions on ignorance in the goal or in
// a condition of an effect, and of the deletion of an atom that is sensed, asked to be false, or a
// condition of an effect.
PddlFiles ToPddl(const GroundTask& task, const std::string& name);

}  // namespace assay::contingent
