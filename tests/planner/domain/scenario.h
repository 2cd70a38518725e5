#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/domain/problem/problem_file.h"

namespace assay::domain {

inline std::filesystem::path ModelsFolder() {
  return std::filesystem::path(ASSAY_SOURCE_DIR) / "models";
}

inline std::filesystem::path ScenarioPath(const std::string& name) {
  return std::filesystem::path(ASSAY_SOURCE_DIR) / "scenarios" / (name + ".yaml");
}

inline Problem LoadScenario(const std::string& name) {
  return ReadProblem(Document::Load(ScenarioPath(name)), ModelsFolder());
}

inline Problem ParseScenario(const std::string& text) {
  return ReadProblem(Document::Parse(text, "scenario.yaml"), ModelsFolder());
}

// Returns the sorted names of all scenarios.
inline std::vector<std::string> AllScenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ScenarioPath("any").parent_path())) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

inline PartId PartNamed(const Problem& problem, const std::string& name) {
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    if (problem.parts[i].name == name) return PartId(i);
  }
  return PartId::None();
}

inline Pose PoseAt(const Part& part, StablePoseId pose, const Placement& placement) {
  return placement.X_WorldTable() * part.model->stable_poses()[pose.index()].X_TablePart;
}

}  // namespace assay::domain
