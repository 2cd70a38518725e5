#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "sim/cli/tree_output/contingent_report.h"
#include "sim/cli/tree_output/dot.h"
#include "sim/python/module.h"
#include "sim/python/refused.h"
#include "sim/python/unlocked.h"

namespace assay::python {
namespace {

namespace py = pybind11;

// How a task is planned for.
struct KnowledgeSettings {
  bool shortest = false;
  bool check = false;
  std::int64_t worlds = 0;
  std::int64_t budget = 0;
};

// Returns the answer as JSON and as text, and its tree for Graphviz.
py::tuple Planned(const contingent::Task& task, const KnowledgeSettings& settings) {
  struct Texts {
    std::string json, text, dot;
  };
  const Texts texts = Unlocked([&] {
    contingent::Externs externs;
    cli::ContingentAnswer answer = cli::PlanFor(
        contingent::Ground(task.domain, task.problem, externs),
        settings.shortest ? contingent::Wanted::kLeastDepth : contingent::Wanted::kFirst,
        settings.budget);
    if (answer.plan.outcome != Outcome::kFound) {
      throw Refused{cli::ExitCodeOf(answer.plan.outcome), Text(answer, false, settings.budget)};
    }
    if (settings.check) {
      answer.check =
          contingent::CheckTree(answer.task, answer.plan.tree, {.worlds = settings.worlds});
    }
    return Texts{cli::JsonText(answer), Text(answer, false, settings.budget),
                 cli::PlanTreeToDot(answer.task, answer.plan.tree)};
  });
  return py::make_tuple(texts.json, texts.text, texts.dot);
}

contingent::Task TaskOfTexts(bool is_pddl, const std::string& domain, const std::string& problem) {
  return contingent::ReadTask(is_pddl ? contingent::Language::kPddl : contingent::Language::kPks,
                              {.text = domain, .name = "domain"},
                              {.text = problem, .name = "problem"});
}

}  // namespace

void AddContingentPlanning(py::module_& module) {
  py::class_<contingent::Task>(module, "Task")
      .def(py::init([](const std::string& domain, const std::string& problem) {
             return contingent::LoadTask(domain, problem);
           }),
           py::arg("domain"), py::arg("problem"))
      .def_static("of_texts", TaskOfTexts, py::arg("is_pddl"), py::arg("domain"),
                  py::arg("problem"))
      .def(
          "plan",
          [](const contingent::Task& task, bool shortest, bool check, std::int64_t worlds,
             std::int64_t budget) {
            return Planned(task, {shortest, check, worlds, budget});
          },
          py::arg("shortest"), py::arg("check"), py::arg("worlds"), py::arg("budget"));
  module.attr("KNOWLEDGE_STATES") = cli::kKnowledgeStates;
  module.attr("WORLDS") = contingent::TreeCheckOptions{}.worlds;
}

}  // namespace assay::python
