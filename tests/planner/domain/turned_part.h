#pragma once

#include <fmt/format.h>

#include <string>

#include "planner/geometry/coordinates.h"


// A peg with a plate, written as a part file in any frame, so that the same part is moved.
namespace assay::domain {

// Returns the part file of the peg moved by X_NewOld, whose rotation must consist of quarter turns.
inline std::string MovedPeg(const geometry::Pose& X_NewOld) {
  const auto box = [&](const geometry::Vector3& a, const geometry::Vector3& b) {
    const geometry::Vector3 p = X_NewOld * a, q = X_NewOld * b;
    const geometry::Vector3 low = p.cwiseMin(q), high = p.cwiseMax(q);
    return fmt::format("[[{}, {}, {}], [{}, {}, {}]]", low.x(), low.y(), low.z(), high.x(),
                       high.y(), high.z());
  };
  const auto direction = [&](const geometry::Vector3& v) {
    const geometry::Vector3 d = X_NewOld.linear() * v;
    return fmt::format("[{}, {}, {}]", d.x(), d.y(), d.z());
  };
  std::string text = "format: assay-part/1\nname: moved\ninitial: M\nunits: {length: mm}\n";
  text += "density: 700\nfriction: 0.25\nsolids:\n";
  text += fmt::format("  plate: {{box: {}}}\n", box({-24, -38, -30}, {0, 38, 46}));
  text += fmt::format("  shaft: {{box: {}}}\n", box({0, -18, -18}, {70, 18, 18}));
  text += "pockets:\n";
  text += fmt::format("  pin: {{cut_from: plate, box: {}}}\n", box({-24, -3, 26}, {0, 3, 32}));
  text += "features:\n";
  text += fmt::format("  1: {{face: plate, normal: {}}}\n", direction({-1, 0, 0}));
  text += fmt::format("  3: {{face: plate, normal: {}}}\n", direction({0, 1, 0}));
  text += fmt::format("  7: {{shaft: shaft, axis: {}}}\n", direction({1, 0, 0}));
  text += fmt::format("  8: {{hole: pin, axis: {}}}\n", direction({1, 0, 0}));
  return text;
}

}  // namespace assay::domain
