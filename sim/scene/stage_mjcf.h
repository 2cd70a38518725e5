#pragma once

#include <cstddef>
#include <string>

#include "planner/domain/problem/problem.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {

// Adds the textures and materials of the whole scene under `asset`.
void AddMaterials(XmlElement& asset);

// Adds everything that does not move under `worldbody`: floor, tables, lights, and cameras. The
// cameras are "overview" (the whole cell), "close" (the parts on the table), "side", "top", and the
// four eyes "overhead-eye-1" to "overhead-eye-4" of the sensor "overhead-camera". `light` is a
// factor on the usual brightness of the lamps.
void AddStage(const domain::Problem& problem, double light, XmlElement& worldbody);

// Tables on which only one part rests. Such a table is invisible. Its height does not depend on the
// heights of the tables under other parts.
struct PartTable {
  domain::PartId part;
  int bit = 0;  // collision bit of the tables, which only this part touches
  bool is_endless = false;
};
// The engine has 31 collision bits. Therefore all parts from the 23rd on share one table, and all
// robots from the 4th on share one bit.
inline constexpr std::size_t kMostPartTables = 23;

// Adds the geom that one part rests on, for each table of the workcell.
void AddPartTables(const domain::Problem& problem, const PartTable& table, XmlElement& worldbody);

// Return the names of a table's geoms. The geom that the hand can touch has the name of the table.
// The geom that the part NAME rests on is "table/NAME"; it is invisible and has a height of its
// own.
std::string TableGeom(const domain::Table& table);
std::string TableGeom(const domain::Table& table, const std::string& part);

// Adds the settings for pictures under `mujoco`.
void AddVisualSettings(const domain::Problem& problem, double light, XmlElement& mujoco);

}  // namespace assay::scene
