#pragma once

#include <pybind11/pybind11.h>

namespace assay::python {

// Each function adds one part of the extension. The functions of the extension release the
// interpreter's lock while they compute.
void AddPlans(pybind11::module_& module);
void AddTrials(pybind11::module_& module);
void AddTrees(pybind11::module_& module);
// The engines that need no scenario: bounds of expressions, labelings of constraint networks,
// contingent planning.
void AddBounds(pybind11::module_& module);
void AddLabels(pybind11::module_& module);
void AddContingentPlanning(pybind11::module_& module);

}  // namespace assay::python
