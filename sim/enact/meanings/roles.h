#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"

namespace assay::enact {

using domain::PartId;
using domain::RobotId;

// What the arguments of an action or an atom are in the workcell: a symbol that is the name of a
// part, a table, a place or a robot stands for it. Other symbols stand for nothing.
struct Roles {
  PartId part = PartId::None();  // the first of these
  std::vector<PartId> parts = {};
  const domain::Table* table = nullptr;       // the first
  const domain::Place* place = nullptr;       // the first
  RobotId robot = RobotId::None();            // the first
  std::span<const std::string> symbols = {};  // the arguments themselves
};
Roles RolesOf(const domain::Problem& problem, std::span<const std::string> arguments);

// The table that a file names. Throws InputError.
const domain::Table& ReadTable(const Value& name, const domain::Problem& problem);

}  // namespace assay::enact
