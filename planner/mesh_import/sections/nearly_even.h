#pragma once

#include <vector>

#include "planner/mesh_import/sections/column.h"

namespace assay::mesh_import {

using Curves = std::vector<Column>;  // of one section

// Returns by how much sections may differ that count as nearly even, in metres: a quarter of a
// step.
inline double MostOfNearlyEven(const ColumnRules& rules) { return rules.most_step / 4; }

// Returns the curves of all sections that are most like one curve.
std::vector<const Column*> LikeCurves(const Column& curve,
                                      const std::vector<const Curves*>& sections);

// Returns by how much sections have material beyond a column: outside of an outline, or inside of a
// hole.
double MaterialBeyond(const Column& column, const std::vector<const Column*>& sections);

// Returns a column for nearly even sections, one of whose curves is given. Nothing of them reaches
// beyond the column by more than rounding, or else it is a step. It has the most material of the
// sections. If they are nearly round, it has the circle around them, or the circle within them if
// it is a hole.
Column NearlyEvenColumn(const Column& curve, const std::vector<const Curves*>& sections,
                        const ColumnRules& rules);

}  // namespace assay::mesh_import
