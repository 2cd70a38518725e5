#include "sim/execution/predicates/roles.h"

#include <algorithm>

namespace assay::execution {

Roles RolesOf(const domain::Problem& problem, std::span<const std::string> arguments) {
  Roles roles;
  roles.symbols = arguments;
  for (const std::string& argument : arguments) {
    const auto part = std::ranges::find(problem.parts, argument, &domain::Part::name);
    if (part != problem.parts.end()) {
      roles.parts.emplace_back(static_cast<std::size_t>(part - problem.parts.begin()));
      roles.part = roles.parts.front();
    }
    const std::vector<domain::Table>& tables = problem.workcell->tables();
    const auto table = std::ranges::find(tables, argument, &domain::Table::name);
    if (table != tables.end() && roles.table == nullptr) roles.table = &*table;
    const std::vector<domain::Place>& places = problem.workcell->places();
    const auto place = std::ranges::find(places, argument, &domain::Place::name);
    if (place != places.end() && roles.place == nullptr) roles.place = &*place;
    const std::vector<domain::Robot>& robots = problem.workcell->robots();
    const auto robot = std::ranges::find(robots, argument, &domain::Robot::name);
    if (robot != robots.end() && roles.robot.IsNone()) {
      roles.robot = RobotId(static_cast<std::size_t>(robot - robots.begin()));
    }
  }
  return roles;
}

const domain::Table& ReadTable(const Value& name, const domain::Problem& problem) {
  std::vector<std::string> names;
  for (const domain::Table& table : problem.workcell->tables()) names.push_back(table.name);
  return problem.workcell->tables()[static_cast<std::size_t>(name.OneOf(names))];
}

}  // namespace assay::execution
