#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/base/interval.h"
#include "planner/base/random.h"
#include "planner/domain/problem/problem.h"
#include "planner/geometry/coordinates.h"
#include "sim/sense/color_sensor.h"

namespace assay::execution {

using domain::PartId;

// A fault just before an action of a plan: a part is moved, or slips in the hand. Neither the plan
// nor the executor knows of the fault.
struct Fault {
  std::string action = {};  // the action's name in the task
  std::string error = {};   // the error that the action's verification should signal
  PartId part = PartId::None();
  geometry::Vector3 way = geometry::Vector3::Zero();
  double turn = 0;

  geometry::Pose After(const geometry::Pose& X_WorldPart) const;
  // Describes the fault: "before plan1-action_2: block moved by (4.0, 0.0, 0.0) mm", or "before
  // plan1-action_2: block turned by 30 degrees".
  std::string Text(const domain::Problem& problem) const;
};

// The properties of a world that neither the planner nor a look at the scene reveals at first.
struct HiddenWorld {
  std::map<PartId, double> masses = {};  // kg
  std::map<PartId, sense::ColorId> colors = {};
  int world = 0;
  std::optional<Fault> fault = {};
};

// The hidden properties that a part may have. An empty list means that this property is not hidden.
struct HiddenKinds {
  std::vector<Interval> masses;        // the mass range of each kind, kg
  std::vector<sense::ColorId> colors;  // the colour of each kind

  bool operator==(const HiddenKinds&) const = default;
};

// The hidden properties that each part may have.
using HiddenParts = std::map<PartId, HiddenKinds>;

// Reads a map like {can1: {mass: [[0.06, 0.12], [0.38, 0.48]]}, bottle: {color: [full, empty]}}.
// Throws InputError.
HiddenParts ReadHiddenParts(const Value& map, const domain::Problem& problem,
                            const std::vector<sense::NamedColor>& colors);

// Narrows the hidden masses of a part's `kinds` to the interval `within`, kg. Ranges outside it are
// removed.
void KeepMasses(const Interval& within, HiddenKinds& kinds);

// Reads the name of one of the colours. Throws InputError.
sense::ColorId ReadColorName(const Value& name, const std::vector<sense::NamedColor>& colors);

// Draws the hidden properties of one part into `world`. Each kind is equally likely, and the mass
// is uniform within the range of its kind.
void DrawPart(PartId part, const HiddenKinds& kinds, RandomStream& random, HiddenWorld& world);
// Draws a world and the hidden properties of all parts. `worlds` is the number of worlds of the
// scenario.
HiddenWorld DrawnWorld(const HiddenParts& parts, int worlds, RandomStream& random);

}  // namespace assay::execution
