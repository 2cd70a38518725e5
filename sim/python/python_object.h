#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json_fwd.hpp>

namespace assay::python {

// Returns JSON as dicts, lists, texts, numbers and None.
pybind11::object ToPython(const nlohmann::ordered_json& json);

}  // namespace assay::python
