#pragma once

#include <fstream>
#include <sstream>
#include <string>

#include "planner/domain/problem/problem_file.h"

namespace assay {

// Returns a scenario of the workcell puma762-table with another workcell.
inline domain::Problem ScenarioIn(const std::string& workcell, const std::string& name) {
  const std::string file = ASSAY_SOURCE_DIR "/scenarios/" + name + ".yaml";
  const std::string usual = "workcell: puma762-table";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string scenario = text.str();
  scenario.replace(scenario.find(usual), usual.size(), "workcell: " + workcell);
  return domain::ReadProblem(Document::Parse(scenario, file), ASSAY_SOURCE_DIR "/models");
}

}  // namespace assay
