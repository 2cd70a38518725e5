#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/base/interval.h"
#include "planner/base/random.h"
#include "planner/domain/problem/problem.h"
#include "planner/geometry/pose.h"
#include "sim/sense/color_sensor.h"

namespace assay::enact {

using domain::PartId;

// Something goes wrong just before an action of a plan, and nobody is told: a part is moved, or
// slips in the hand.
struct Fault {
  std::string action = {};  // by its name in the task
  std::string error = {};   // that its verification is to signal
  PartId part = PartId::None();
  geometry::Vector3 way = geometry::Vector3::Zero();  // world, metres
  double turn = 0;                                    // about the vertical, radians

  geometry::Pose After(const geometry::Pose& X_WorldPart) const;
  // "before plan1-action_2: block moved by (4.0, 0.0, 0.0) mm"; "... turned by 30 degrees"
  std::string Text(const domain::Problem& problem) const;
};

// What a world hides from the planner and from the eye.
struct HiddenWorld {
  std::map<PartId, double> masses = {};  // kg
  std::map<PartId, sense::ColorId> colors = {};
  int world = 0;  // of the scenario's worlds (domain::ReadWorlds): which poses are the true ones
  std::optional<Fault> fault = {};
};

// What may be hidden in a part; an empty list: nothing of that sort.
struct HiddenKinds {
  std::vector<Interval> masses;        // the range of each kind, kg
  std::vector<sense::ColorId> colors;  // of each kind

  bool operator==(const HiddenKinds&) const = default;
};

// The worlds that there may be.
using HiddenParts = std::map<PartId, HiddenKinds>;

// {can1: {mass: [[0.06, 0.12], [0.38, 0.48]]}, bottle: {color: [full, empty]}, ...}. Throws
// InputError.
HiddenParts ReadHiddenParts(const Value& map, const domain::Problem& problem,
                            const std::vector<sense::NamedColor>& colors);

// Keeps of the ranges of masses what is within the interval.
void KeepMasses(const Interval& within, HiddenKinds& kinds);

// Which of the colours the file names. Throws InputError.
sense::ColorId ReadColorName(const Value& name, const std::vector<sense::NamedColor>& colors);

// A kind, each as likely, and a mass within it: what is hidden in one part, or in all.
void DrawPart(PartId part, const HiddenKinds& kinds, RandomStream& random, HiddenWorld& world);
// `worlds`: how many the scenario has.
HiddenWorld DrawnWorld(const HiddenParts& parts, int worlds, RandomStream& random);

}  // namespace assay::enact
