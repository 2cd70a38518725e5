#pragma once

#include <vector>

#include "planner/domain/grasp/grasp.h"
#include "planner/domain/part/part_model.h"
#include "sim/cli/plans/report.h"

namespace assay::cli {

// The computed stable poses and grasps of a part.
Report ReportOn(const domain::PartModel& part, const std::vector<domain::Grasp>& grasps);

// "7 8"; "-" if there are none.
std::string FeatureText(const std::vector<domain::FeatureNumber>& numbers);
// "1.000 0.000 0.000".
std::string DirectionText(const geometry::Vector3& v);
// "BP5 on-back".
std::string StablePoseText(const domain::PartModel& part, domain::StablePoseId pose);

std::string StablePoseTable(const domain::PartModel& part);
nlohmann::ordered_json StablePosesToJson(const domain::PartModel& part);

}  // namespace assay::cli
