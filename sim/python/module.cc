#include "sim/python/module.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <nlohmann/json.hpp>

#include "planner/base/input_files/input_error.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/python/planning.h"
#include "sim/python/python_object.h"
#include "sim/python/refused.h"
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

// Does the trials of a sweep that are not in the database yet. Returns how many are done and left,
// and whether Ctrl-C was pressed.
py::dict RunSweep(const fs::path& file, const fs::path& database,
                  const std::vector<fs::path>& folders, int jobs, bool resume) {
  const auto made = UnlockedUntilStopped([&] {
    const domain::ModelPath models = ModelPathOf(folders);
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
  dict["done"] = made.result->done;
  dict["before"] = made.result->before;
  dict["left"] = made.result->left;
  dict["is_interrupted"] = made.is_interrupted;
  return dict;
}

}  // namespace

PYBIND11_MODULE(_assay, module) {
  module.doc() = "The libraries of assay. The package assay calls these functions.";
  module.attr("__version__") = ASSAY_VERSION;
  py::register_exception_translator(Translate);
  AddPlans(module);
  AddTrials(module);
  AddTrees(module);
  AddBounds(module);
  AddLabels(module);
  AddContingentPlanning(module);
  module.def("run_sweep", RunSweep, py::arg("file"), py::arg("database"), py::arg("models"),
             py::arg("jobs"), py::arg("resume"));
  module.def(
      "require_database",
      [](const fs::path& file) {
        Unlocked([&] { return sweep::Store::Open(file).TrialsInAll(); });
      },
      py::arg("file"));
}

}  // namespace assay::python
