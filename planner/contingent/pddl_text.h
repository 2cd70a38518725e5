#pragma once

#include <string>

#include "planner/contingent/ground_task.h"

namespace assay::contingent {

struct PddlFiles {
  std::string domain;
  std::string problem;
};

// The ground task as contingent PDDL, in the fragment that ReadPddlDomain reads: atoms are
// predicates without arguments, K of a literal is the literal, add(Kw, a) is :observe, Kx is oneof,
// what is not known is (unknown a). Where PKS says more than PDDL can, the world is what PDDL has:
// what is deleted from Kf is false from then on; that something is not known is not asked. Throws
// InputError, naming what it is, for intervals, run-time variables, conjunctions in Kw, actions
// that sense several things, and update rules. `place` is the file to be named.
PddlFiles ToPddl(const GroundTask& task, const std::string& name, const FilePlace& place);

}  // namespace assay::contingent
