#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "planner/base/input_files/input_error.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/python/engines.h"
#include "sim/python/planning.h"
#include "sim/python/python_object.h"
#include "sim/python/refused.h"
#include "sim/python/trials.h"
#include "sim/python/unlocked.h"
#include "sim/sweep/runner/machine.h"
#include "sim/sweep/runner/runner.h"

namespace assay::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Raises the exception of an exit code.
void Raise(cli::ExitCode code, const std::string& text, const Json* json = nullptr) {
  const py::object raise = py::module_::import("assay.errors").attr("_raise");
  try {
    raise(static_cast<int>(code), text, json == nullptr ? py::none() : ToPython(*json));
  } catch (py::error_already_set& error) {
    error.restore();
  }
}

void Translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Refused& refused) {
    Raise(refused.code, refused.text, refused.json.get());
  } catch (const cli::UsageError& error) {
    Raise(cli::ExitCode::kWrongCommandLine, error.what());
  } catch (const InputError& error) {
    Raise(cli::ExitCode::kWrongInput, error.what());
  } catch (const EnvironmentError& error) {
    Raise(cli::ExitCode::kEnvironment, error.what());
  } catch (const std::system_error& error) {
    Raise(cli::ExitCode::kEnvironment, error.what());
  }
}

// Does the trials of a sweep that are not in the database yet.
py::dict RunSweep(const fs::path& file, const fs::path& database,
                  const std::vector<fs::path>& folders, int jobs, bool resume) {
  const sweep::RunEnd end = Unlocked([&] {
    domain::ModelPath models;
    for (const fs::path& folder : folders) models.Append(folder);
    const sweep::Sweep sweep = sweep::Load(file);
    const sweep::SweepFacts facts = sweep::FactsOf(sweep, ASSAY_VERSION);
    sweep::Store store =
        resume ? sweep::Store::Resume(database, facts) : sweep::Store::Create(database, facts);
    store.Add(sweep::ThisRun(ASSAY_VERSION, "1/1", jobs));
    sweep::RunEnd done =
        sweep::RunSweep(sweep, sweep::RealWork(sweep, models, cli::KeptNoiseFloor), store,
                        {.jobs = jobs, .stop = [] { return stop_requested.load(); }});
    store.Finish(done.throughput);
    store.Close();
    return done;
  });
  py::dict dict;
  dict["done"] = end.done;
  dict["before"] = end.before;
  dict["left"] = end.left;
  return dict;
}

// Each function of the class gives the interpreter free while it computes.
void AddPlans(py::module_& module) {
  py::class_<PlanSettings>(module, "PlanSettings")
      .def(py::init<>())
      .def_readwrite("scenario", &PlanSettings::scenario)
      .def_readwrite("models", &PlanSettings::models)
      .def_readwrite("clearance", &PlanSettings::clearance)
      .def_readwrite("error_scale", &PlanSettings::error_scale)
      .def_readwrite("resolvers", &PlanSettings::resolvers)
      .def_readwrite("propagation", &PlanSettings::propagation)
      .def_readwrite("partial_plans", &PlanSettings::partial_plans);
  module.attr("PARTIAL_PLANS") = constraint_posting::PlannerOptions().partial_plans;
  module.def("describe", [](const PlanSettings& settings) {
    return ToPython(Unlocked([&] { return Described(settings); }));
  });
  py::class_<PlanHandle, std::shared_ptr<PlanHandle>>(module, "Plan")
      .def_static("make",
                  [](const PlanSettings& settings) {
                    return std::const_pointer_cast<PlanHandle>(
                        Unlocked([&] { return PlanHandle::Make(settings); }));
                  })
      .def_static("read",
                  [](const fs::path& file, const std::vector<fs::path>& models) {
                    return std::const_pointer_cast<PlanHandle>(
                        Unlocked([&] { return PlanHandle::Read(file, models); }));
                  })
      .def("json", [](const PlanHandle& plan) { return ToPython(plan.ToJson()); })
      .def("file_text", &PlanHandle::FileText)
      .def("text", &PlanHandle::Text)
      .def("explain", [](const PlanHandle& plan,
                         int step) { return Unlocked([&] { return plan.Explanation(step); }); })
      .def("proofs",
           [](const PlanHandle& plan) { return ToPython(Unlocked([&] { return plan.Proofs(); })); })
      .def("check",
           [](const PlanHandle& plan) {
             return ToPython(Unlocked([&] { return plan.CheckedToJson(); }));
           })
      .def("error_box", [](const PlanHandle& plan) { return ToPython(ErrorBoxOf(plan)); });
}

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
      .def("page", &TracedTrial::Page);
  py::class_<Trials, std::shared_ptr<Trials>>(module, "Trials")
      .def(py::init([](std::shared_ptr<PlanHandle> plan, const TrialSettings& settings,
                       bool is_falsification) {
        return Unlocked([&] { return std::make_shared<Trials>(plan, settings, is_falsification); });
      }))
      .def_property_readonly("seed", &Trials::seed)
      .def(
          "wrong_without_noise",
          [](const Trials& trials) { return Unlocked([&] { return trials.WrongWithoutNoise(); }); })
      .def("run",
           [](const Trials& trials, int count, int jobs) {
             py::list rows;
             for (const sweep::TimedTrial& timed :
                  Unlocked([&] { return trials.Run(count, jobs); })) {
               rows.append(ToPython(ToJson(timed)));
             }
             return rows;
           })
      .def("traced",
           [](const Trials& trials, int number) {
             return std::const_pointer_cast<TracedTrial>(
                 Unlocked([&] { return trials.Traced(number); }));
           })
      .def("attack", [](const Trials& trials, std::int64_t attempts, int jobs) {
        const MadeFalsification made = Unlocked([&] { return trials.Falsify(attempts, jobs); });
        return py::make_tuple(made.untestable, ToPython(ToJson(made.record)),
                              ToPython(ToJson(*made.record.falsification)));
      });
}

}  // namespace

PYBIND11_MODULE(_assay, module) {
  module.doc() = "The libraries of assay. The package assay calls these functions.";
  module.attr("__version__") = ASSAY_VERSION;
  py::register_exception_translator(Translate);
  AddPlans(module);
  AddTrials(module);
  AddBounds(module);
  AddLabels(module);
  AddContingentPlanning(module);
  module.def("run_sweep", RunSweep);
  module.def("require_database", [](const fs::path& file) {
    Unlocked([&] { return sweep::Store::Open(file).TrialsInAll(); });
  });
}

}  // namespace assay::python
