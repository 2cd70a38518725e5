#pragma once

#include <vector>

#include "planner/domain/grasps/grasp.h"
#include "planner/domain/parts/part_model.h"
#include "sim/cli/plan_output/report.h"

namespace assay::cli {

// Reports the computed stable poses and grasps of a part.
Report ReportOn(const domain::PartModel& part, const std::vector<domain::Grasp>& grasps);

// Returns the direction as text: "1.000 0.000 0.000".
std::string DirectionText(const geometry::Vector3& v);
// Returns a stable pose's label and name: "BP5 on-back".
std::string StablePoseText(const domain::PartModel& part, domain::StablePoseId pose);

std::string StablePoseTable(const domain::PartModel& part);
nlohmann::ordered_json StablePosesToJson(const domain::PartModel& part);

}  // namespace assay::cli
