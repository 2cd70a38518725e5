#pragma once

#include "planner/domain/problem.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {

// Adds textures and materials of everything, under `asset`.
void AddMaterials(XmlElement& asset);

// Adds what does not move, under `worldbody`: floor, table, lights, and the cameras "overview"
// (the whole cell), "close" (the parts on the table), "side" and "top".
void AddStage(const domain::Problem& problem, XmlElement& worldbody);

// Adds the pictures' settings, under `mujoco`.
void AddVisualSettings(const domain::Problem& problem, XmlElement& mujoco);

}  // namespace assay::scene
