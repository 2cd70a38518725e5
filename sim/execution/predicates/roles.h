#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"

namespace assay::execution {

using domain::PartId;
using domain::RobotId;

// The meaning of the arguments of an action or an atom in the workcell. A symbol that is the name
// of a part, a table, a place or a robot stands for this thing. Other symbols have no meaning in
// the workcell.
struct Roles {
  PartId part = PartId::None();               // the first part among the arguments
  std::vector<PartId> parts = {};             // all parts among the arguments
  const domain::Table* table = nullptr;       // the first table
  const domain::Place* place = nullptr;       // the first place
  RobotId robot = RobotId::None();            // the first robot
  std::span<const std::string> symbols = {};  // the arguments themselves
};
// Finds the parts, tables, places and robots that the arguments name.
Roles RolesOf(const domain::Problem& problem, std::span<const std::string> arguments);

// Returns the table that the file names. Throws InputError.
const domain::Table& ReadTable(const Value& name, const domain::Problem& problem);

}  // namespace assay::execution
