#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>

#include "planner/plan/plan_files/json_layout.h"
#include "sim/python/module.h"
#include "sim/python/python_object.h"
#include "sim/python/trees.h"
#include "sim/python/unlocked.h"

namespace assay::python {

namespace py = pybind11;

namespace {

std::vector<std::shared_ptr<PlanHandle>> MutablePlans(const TreeHandle& tree) {
  std::vector<std::shared_ptr<PlanHandle>> plans;
  for (const auto& plan : tree.plans()) plans.push_back(std::const_pointer_cast<PlanHandle>(plan));
  return plans;
}

// Returns what `assay run --json` prints, and whether Ctrl-C was pressed.
py::tuple RunTree(const TreeTrials& trials, int count, int jobs) {
  const auto made = UnlockedUntilStopped([&] { return trials.Run(count, jobs); });
  return py::make_tuple(ToPython(*made.result), made.is_interrupted);
}

void AddTreeTrials(py::module_& module) {
  py::class_<TreeTrialSettings>(module, "TreeTrialSettings")
      .def(py::init<>())
      .def_readwrite("is_every_leaf", &TreeTrialSettings::is_every_leaf)
      .def_readwrite("sensing_errors", &TreeTrialSettings::sensing_errors)
      .def_readwrite("seed", &TreeTrialSettings::seed);
  py::class_<TreeTrials, std::shared_ptr<TreeTrials>>(module, "TreeTrials")
      .def(py::init([](std::shared_ptr<TreeHandle> tree, const TreeTrialSettings& settings) {
             return Unlocked([&] { return std::make_shared<TreeTrials>(tree, settings); });
           }),
           py::arg("tree"), py::arg("settings"))
      .def_property_readonly("seed", &TreeTrials::seed)
      .def_property_readonly("usual_count", &TreeTrials::usual_count)
      .def("run", RunTree, py::arg("count"), py::arg("jobs"))
      .def(
          "traced",
          [](const TreeTrials& trials, int number) {
            return std::const_pointer_cast<TracedTrial>(
                Unlocked([&] { return trials.Traced(number); }));
          },
          py::arg("number"));
}

}  // namespace

void AddTrees(py::module_& module) {
  py::class_<TreeHandle, std::shared_ptr<TreeHandle>>(module, "Tree")
      .def_static(
          "make",
          [](const PlanSettings& settings) {
            return std::const_pointer_cast<TreeHandle>(
                Unlocked([&] { return TreeHandle::Make(settings); }));
          },
          py::arg("settings"))
      .def("json", [](const TreeHandle& tree) { return ToPython(tree.ToJson()); })
      .def("file_text", [](const TreeHandle& tree) { return plan::JsonText(tree.ToJson()); })
      .def("text", &TreeHandle::Text)
      .def("dot", &TreeHandle::Dot)
      .def("lines", [](const TreeHandle& tree) { return ToPython(tree.Lines()); })
      .def("plans", MutablePlans)
      .def(
          "check",
          [](const TreeHandle& tree, std::int64_t worlds) {
            return ToPython(Unlocked([&] { return tree.Checked(worlds); }));
          },
          py::arg("worlds"));
  AddTreeTrials(module);
}

}  // namespace assay::python
