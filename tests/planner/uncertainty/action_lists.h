#pragma once

#include <string>
#include <vector>

#include "planner/constraint_posting/posting_planner.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/oracle/executed_errors.h"

// Problems and lists of actions for tests that certify.
namespace assay::uncertainty {

using oracle::CertifiedAction;

constexpr double kInch = 0.0254;
constexpr double kDegree = 3.14159265358979323846 / 180;

inline domain::Problem LoadScenario(const std::string& name) {
  const std::string root = ASSAY_SOURCE_DIR;
  return domain::ReadProblem(Document::Load(root + "/scenarios/" + name + ".yaml"),
                             root + "/models");
}

inline PartId PartNamed(const domain::Problem& problem, const std::string& name) {
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    if (problem.parts[i].name == name) return PartId(static_cast<int>(i));
  }
  return PartId::None();
}

inline domain::PoseError Symmetric(double length, double angle) {
  const Interval l{-length, length};
  return {l, l, l, {-angle, angle}};
}

// Returns the first plan of the first phase, in its order of execution.
inline std::vector<plan::Action> FirstPlan(const domain::Problem& problem) {
  const plan::PlanResult result = constraint_posting::MakePlan(problem, {});
  std::vector<plan::Action> actions;
  for (plan::StepId id : result.plan.ExecutionOrder()) {
    actions.push_back(result.plan.step(id).action);
  }
  return actions;
}

// Returns the grasps of the part that are reachable at its initial pose.
inline std::vector<plan::Hold> HoldsAtStart(const domain::Problem& problem, PartId part) {
  std::vector<plan::Hold> holds;
  const domain::Part& body = problem.part(part);
  for (std::size_t i = 0; i < body.grasps->size(); ++i) {
    if (!domain::IsReachableAt(problem, part, domain::GraspId(static_cast<int>(i)),
                               body.X_WorldPart)) {
      continue;
    }
    const domain::Grasp& grasp = (*body.grasps)[i];
    holds.push_back({grasp.label, grasp.X_PartTool, grasp.width});
  }
  return holds;
}

inline std::vector<CertifiedAction> Certify(const domain::Problem& problem,
                                            const std::vector<plan::Action>& actions,
                                            Propagation propagation = Propagation::kSound,
                                            const algebra::BoundRequest& request = {}) {
  UncertainWorld world(problem, propagation);
  std::vector<CertifiedAction> certified;
  for (const plan::Action& action : actions) {
    certified.push_back({action, CertifyStep(world, action, request).certificate});
  }
  return certified;
}

}  // namespace assay::uncertainty
