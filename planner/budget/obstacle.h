#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::budget {

// What keeps a plan from being proved.
struct Obstacle {
  std::string step;     // name of the step; empty if there is no plan
  std::string meaning;  // of the precondition that is not proved, or why there is no plan
};

// Returns the first obstacle in a plan that was made with other errors than the problem has: in its
// certificates, which are computed anew, in its strategies, or in its ways. The plan must be
// executable.
std::optional<Obstacle> ObstacleOfPlan(const domain::Problem& problem, const plan::Plan& plan);

// Returns what a plan needs beside certificates and is not proved: its strategies and its ways.
std::vector<Obstacle> ObstaclesBesideCertificates(const domain::Problem& problem,
                                                  const plan::Plan& plan);

// Makes a plan for the problem, and returns it with the first obstacle in it.
struct PlannedAnew {
  plan::PlanResult result;
  std::optional<Obstacle> obstacle;
};
PlannedAnew PlanAnew(const domain::Problem& problem);

}  // namespace assay::budget
