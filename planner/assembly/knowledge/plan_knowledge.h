#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/language/domain.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// A plan, and the worlds in which it works.
struct PlanOfWorlds {
  std::vector<int> worlds;  // in increasing order
  plan::Plan plan;
};

// The meaning in the workcell of an action of the knowledge-level task.
struct KnowledgeAction {
  enum class Kind {
    // A sensor looks at a part whose pose is open. The part's pose becomes known, and its position
    // becomes known as precisely as the sensor allows.
    kLook,
    kStep,      // a step of a plan
    kVerify,    // the verifications after a step find out whether the step passes them
    kDiagnose,  // finds out whether the failed verification signals this error
    kRecover,   // The next attempt of the step's recovery from an error. Its result is open.
    kOperator,  // no recovery is prepared, so a person takes over
  };
  Kind kind = Kind::kStep;
  domain::PartId part = domain::PartId::None();  // for kLook
  std::string sensor = {};
  int plan = -1;  // the index of the plan, for all other kinds
  plan::StepId step = plan::StepId::None();
  std::string name = {};   // the name of the step in the task
  std::string error = {};  // for kDiagnose, kRecover and kOperator
};

// Plans as a contingent planning problem (planner/contingent). Looks distinguish the worlds,
// verifications find out whether a step passed, and recoveries lead back to a verification. Spar's
// augmented plan instance becomes one tree. For each part whose pose is open there are:
//   pose(part)                Kx over its poses. A look puts it in Kv if the sensor distinguishes
//                             the poses.
//   dx, dy, theta (part)      The intervals of the part's error variables of SUP/INF. A look
//                             narrows them to the sensor's bounds. Plans that were certified with
//                             these bounds require them.
//   moved(part)               The part was picked up. Its pose and errors are then unknown, and a
//                             look cannot find them out.
//
// Looks at other parts and later looks are steps of their plans. Each step has done(step), and each
// verified step has passed(step) and signals(step, error).
struct PlanKnowledge {
  contingent::Domain domain;
  contingent::Problem problem;
  contingent::GroundTask task;
  std::map<std::string, KnowledgeAction> actions;  // indexed by the names of the task's actions
  // Indexed by the task's constants: the names that errors, parts and poses have in the workcell
  // and in the scenario. These names may be any text.
  std::map<std::string, std::string> names;
};

// Returns the plans as a contingent planning problem. The worlds belong to one scenario
// (domain::ReadWorlds), and each world has at most one plan.
PlanKnowledge KnowledgeOf(const std::vector<domain::Problem>& worlds,
                          const std::vector<PlanOfWorlds>& plans);

}  // namespace assay::assembly
