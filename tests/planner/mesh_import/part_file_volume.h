#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "planner/base/input_files/document.h"

// Computes the volume of a part from the numbers in its part file.
namespace assay::mesh_import {

inline double AreaInFile(const Value& outline) {
  std::vector<std::vector<double>> corners;
  for (const Value& corner : outline.Items()) corners.push_back(corner.Numbers(2));
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % corners.size()];
    area += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return std::abs(area);
}

// Returns the volume of a solid or a pocket in cubic millimetres. Round ones count as round.
inline double VolumeOfEntry(const Value& entry) {
  const auto length = [](const Value& round) {
    const std::vector<double> from = round.At("from").Numbers(3);
    const std::vector<double> to = round.At("to").Numbers(3);
    return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  };
  if (const auto box = entry.Find("box")) {
    const std::vector<double> low = box->Items()[0].Numbers(3);
    const std::vector<double> high = box->Items()[1].Numbers(3);
    return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
  }
  if (const auto cylinder = entry.Find("cylinder"))
    return std::numbers::pi * std::pow(cylinder->At("radius").Number(), 2) * length(*cylinder);
  if (const auto cone = entry.Find("cone")) {
    const std::vector<double> radii = cone->At("radii").Numbers(2);
    return std::numbers::pi * length(*cone) *
           (radii[0] * radii[0] + radii[0] * radii[1] + radii[1] * radii[1]) / 3;
  }
  const Value prism = entry.At("prism");
  return AreaInFile(prism.At("outline")) * (prism.At("to").Number() - prism.At("from").Number());
}

inline double VolumeInFile(const Value& part) {
  double volume = 0;
  for (const auto& [name, solid] : part.At("solids").Entries()) volume += VolumeOfEntry(solid);
  if (const auto pockets = part.Find("pockets")) {
    for (const auto& [name, pocket] : pockets->Entries()) volume -= VolumeOfEntry(pocket);
  }
  return volume;
}

}  // namespace assay::mesh_import
