#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// A plan, and the worlds in which it works.
struct PlanOfWorlds {
  std::vector<int> worlds;  // increasing
  plan::Plan plan;
};

// What an action of the knowledge level does in the workcell.
struct KnowledgeAction {
  enum class Kind {
    kLook,      // a sensor looks at a part whose pose is open: which pose it has becomes known, and
                // where it is, as well as the sensor tells
    kStep,      // a step of a plan
    kVerify,    // the verifications that follow a step: whether it passes them
    kDiagnose,  // whether what they signal is this error
    kRecover,   // the next try of the step's recovery from an error; how it went is open
    kOperator,  // nothing is prepared: a person takes over
  };
  Kind kind = Kind::kStep;
  domain::PartId part = domain::PartId::None();  // of a look
  std::string sensor = {};
  int plan = -1;  // of the others
  plan::StepId step = plan::StepId::None();
  std::string name = {};   // of the step, as the task has it
  std::string error = {};  // of kDiagnose, kRecover and kOperator
};

// Plans seen as knowledge: a contingent planning problem (planner/contingent) in which looks tell
// the worlds apart, verifications tell whether a step passed, and recoveries lead back to a
// verification. Spar's augmented plan instance becomes one tree. For each part whose pose is open:
//   pose(part)                 Kx over its poses; a look makes it Kv, if the sensor tells them
//   apart dx, dy, theta (part)       numeric: the intervals of the part's error variables of
//   SUP/INF; a
//                              look narrows them to what the sensor promises, and plans that were
//                              certified with that require it
//   moved(part)                it was picked up: neither is known any more, nor told by a look
// Looks at other parts, and later ones, are steps of their plans. For each step there is
// done(step), and for each verified step passed(step) and signals(step, error).
struct PlanKnowledge {
  std::string domain;   // .pks
  std::string problem;  // .pks
  contingent::GroundTask task;
  std::map<std::string, KnowledgeAction> actions;  // by the names of the task's
  // What errors, parts and poses are named in the workcell and the scenario, which may be any text,
  // by the task's constants.
  std::map<std::string, std::string> names;
};

// The open poses on which it depends whether a plan for these worlds works: of the others, every
// choice leads to one of them.
std::vector<domain::OpenPose> PosesThatMatter(const std::vector<domain::Problem>& worlds,
                                              const std::vector<int>& of_plan);

// The worlds are of one scenario (domain::ReadWorlds), and every one has at most one plan.
PlanKnowledge KnowledgeOf(const std::vector<domain::Problem>& worlds,
                          const std::vector<PlanOfWorlds>& plans);

}  // namespace assay::assembly
