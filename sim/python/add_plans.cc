#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>

#include "sim/python/module.h"
#include "sim/python/planning.h"
#include "sim/python/python_object.h"
#include "sim/python/trials.h"
#include "sim/python/unlocked.h"

namespace assay::python {

namespace py = pybind11;

namespace {

void AddSettings(py::module_& module) {
  py::class_<PlanSettings>(module, "PlanSettings")
      .def(py::init<>())
      .def_readwrite("scenario", &PlanSettings::scenario)
      .def_readwrite("models", &PlanSettings::models)
      .def_readwrite("clearance", &PlanSettings::clearance)
      .def_readwrite("error_scale", &PlanSettings::error_scale)
      .def_readwrite("resolvers", &PlanSettings::resolvers)
      .def_readwrite("propagation", &PlanSettings::propagation)
      .def_readwrite("budget", &PlanSettings::budget);
  module.def(
      "describe",
      [](const PlanSettings& settings) {
        return ToPython(Unlocked([&] { return Described(settings); }));
      },
      py::arg("settings"));
}

void AddHandle(py::module_& module) {
  py::class_<PlanHandle, std::shared_ptr<PlanHandle>>(module, "Plan")
      .def_static(
          "make",
          [](const PlanSettings& settings) {
            return std::const_pointer_cast<PlanHandle>(
                Unlocked([&] { return PlanHandle::Make(settings); }));
          },
          py::arg("settings"))
      .def_static(
          "read",
          [](const std::filesystem::path& file, const std::vector<std::filesystem::path>& models) {
            return std::const_pointer_cast<PlanHandle>(
                Unlocked([&] { return PlanHandle::Read(file, models); }));
          },
          py::arg("file"), py::arg("models"))
      .def("json", [](const PlanHandle& plan) { return ToPython(plan.ToJson()); })
      .def("file_text", &PlanHandle::FileText)
      .def("text", &PlanHandle::Text)
      .def(
          "explain",
          [](const PlanHandle& plan, int step) {
            return Unlocked([&] { return plan.Explanation(step); });
          },
          py::arg("step"))
      .def("proofs",
           [](const PlanHandle& plan) { return ToPython(Unlocked([&] { return plan.Proofs(); })); })
      .def(
          "budget",
          [](const PlanHandle& plan, const std::vector<std::string>& front) {
            return ToPython(Unlocked([&] { return plan.Budget(front); }));
          },
          py::arg("front"))
      .def("check",
           [](const PlanHandle& plan) {
             return ToPython(Unlocked([&] { return plan.CheckedToJson(); }));
           })
      .def("error_box", [](const PlanHandle& plan) { return ToPython(ErrorBoxOf(plan)); });
}

}  // namespace

void AddPlans(py::module_& module) {
  AddSettings(module);
  AddHandle(module);
}

}  // namespace assay::python
