#pragma once

#include <pybind11/pybind11.h>

namespace assay::python {

// Add the engines that need no scenario to the module: bounds of expressions, labelings of
// constraint networks, contingent planning.
void AddBounds(pybind11::module_& module);
void AddLabels(pybind11::module_& module);
void AddContingentPlanning(pybind11::module_& module);

}  // namespace assay::python
