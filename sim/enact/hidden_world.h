#pragma once

#include <map>
#include <vector>

#include "planner/base/document.h"
#include "planner/base/interval.h"
#include "planner/base/random.h"
#include "planner/domain/problem.h"

namespace assay::enact {

using domain::PartId;

// What a world hides from the planner and from the eye.
struct HiddenWorld {
  std::map<PartId, double> masses;  // kg
};

// The worlds that there may be: of each part the kinds that it may be of, each with the range of
// its mass, kg.
using HiddenMasses = std::map<PartId, std::vector<Interval>>;

// {can1: {mass: [[0.06, 0.12], [0.38, 0.48]]}, ...}. Throws InputError.
HiddenMasses ReadHiddenMasses(const Value& map, const domain::Problem& problem);

// A kind, each as likely, and a mass within it.
double DrawnMass(const std::vector<Interval>& kinds, RandomStream& random);
HiddenWorld DrawnWorld(const HiddenMasses& masses, RandomStream& random);

}  // namespace assay::enact
