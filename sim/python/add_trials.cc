#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>

#include "sim/python/module.h"
#include "sim/python/python_object.h"
#include "sim/python/trials.h"
#include "sim/python/unlocked.h"

namespace assay::python {

namespace py = pybind11;

namespace {

// Returns the rows of the trials, and whether Ctrl-C was pressed.
py::tuple Run(const Trials& trials, int count, int jobs) {
  const auto made = UnlockedUntilStopped([&] { return trials.Run(count, jobs); });
  py::list rows;
  for (const sweep::TimedTrial& timed : *made.result) rows.append(ToPython(ToJson(timed)));
  return py::make_tuple(rows, made.is_interrupted);
}

// Returns why the plan cannot be tested, the trial, the falsification, and whether Ctrl-C was
// pressed.
py::tuple Falsify(const Trials& trials, std::int64_t attempts, int jobs) {
  const auto made = UnlockedUntilStopped([&] { return trials.Falsify(attempts, jobs); });
  return py::make_tuple(made.result->untestable, ToPython(ToJson(made.result->record)),
                        ToPython(ToJson(*made.result->record.falsification)), made.is_interrupted);
}

std::shared_ptr<TracedTrial> Traced(const Trials& trials, int number) {
  return std::const_pointer_cast<TracedTrial>(Unlocked([&] { return trials.Traced(number); }));
}

}  // namespace

void AddTrials(py::module_& module) {
  py::class_<TrialSettings>(module, "TrialSettings")
      .def(py::init<>())
      .def_readwrite("noise", &TrialSettings::noise)
      .def_readwrite("errors", &TrialSettings::errors)
      .def_readwrite("sensing", &TrialSettings::sensing)
      .def_readwrite("grasp", &TrialSettings::grasp)
      .def_readwrite("seed", &TrialSettings::seed);
  py::class_<TracedTrial, std::shared_ptr<TracedTrial>>(module, "TracedTrial")
      .def("lines", &TracedTrial::Lines)
      .def("page", [](const TracedTrial& trial) { return Unlocked([&] { return trial.Page(); }); });
  py::class_<Trials, std::shared_ptr<Trials>>(module, "Trials")
      .def(py::init([](std::shared_ptr<PlanHandle> plan, const TrialSettings& settings,
                       bool is_falsification) {
             return Unlocked(
                 [&] { return std::make_shared<Trials>(plan, settings, is_falsification); });
           }),
           py::arg("plan"), py::arg("settings"), py::arg("is_falsification"))
      .def_property_readonly("seed", &Trials::seed)
      .def(
          "wrong_without_noise",
          [](const Trials& trials) { return Unlocked([&] { return trials.WrongWithoutNoise(); }); })
      .def("run", Run, py::arg("count"), py::arg("jobs"))
      .def("traced", Traced, py::arg("number"))
      .def("falsify", Falsify, py::arg("attempts"), py::arg("jobs"));
}

}  // namespace assay::python
