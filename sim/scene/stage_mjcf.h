#pragma once

#include <cstddef>
#include <string>

#include "planner/domain/problem/problem.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {

// Adds textures and materials of everything, under `asset`.
void AddMaterials(XmlElement& asset);

// Adds what does not move, under `worldbody`: floor, tables, lights, and the cameras "overview"
// (the whole cell), "close" (the parts on the table), "side" and "top", and "overhead-eye-1" to
// "overhead-eye-4" of the sensor "overhead-camera".
// `light`: how bright the lamps are, 1 being as usual.
void AddStage(const domain::Problem& problem, double light, XmlElement& worldbody);

// What a single part rests on, not drawn: the table, at a height of its own.
struct PartTable {
  domain::PartId part;
  int bit = 0;  // that it is, and that the part touches
  bool is_endless = false;
};
// The engine has 31 bits: parts from the 23rd on share a table, robots from the
// 4th on a bit.
inline constexpr std::size_t kMostPartTables = 23;

// Adds it, once for each table of the workcell.
void AddPartTables(const domain::Problem& problem, const PartTable& table, XmlElement& worldbody);

// The name of a table as a geom, for the hand: the table's own. For a part: "table/NAME", what the
// part rests on, not drawn, at a height of its own.
std::string TableGeom(const domain::Table& table);
std::string TableGeom(const domain::Table& table, const std::string& part);

// Adds the pictures' settings, under `mujoco`.
void AddVisualSettings(const domain::Problem& problem, double light, XmlElement& mujoco);

}  // namespace assay::scene
