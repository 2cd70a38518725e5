#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "planner/algebra/bounds/bound_file.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/bounds/sensitivity.h"
#include "planner/algebra/expression/text.h"
#include "planner/algebra/sup_inf/sup_inf.h"
#include "sim/python/module.h"
#include "sim/python/unlocked.h"

namespace assay::python {
namespace {

namespace py = pybind11;
using algebra::BothBounds;
using algebra::BoundProblem;
using algebra::BoundRequest;
using algebra::VariableId;
using Boxes = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Expressions over bounded variables, prepared for being bounded over many boxes.
class Expressions {
 public:
  // `text` has the form of the files of `assay bound`.
  explicit Expressions(const std::string& text, const std::string& name)
      : problem_(algebra::ReadBoundProblem(text, name)) {
    for (const BoundProblem::Question& question : problem_.questions) {
      prepared_.emplace_back(question.expression);
    }
  }

  std::vector<std::string> Variables() const {
    std::vector<std::string> names;
    for (int v = 0; v < problem_.pool->variable_count(); ++v) {
      names.push_back(problem_.pool->name(VariableId(v)));
    }
    return names;
  }
  std::vector<std::string> Texts() const {
    std::vector<std::string> texts;
    for (const BoundProblem::Question& question : problem_.questions)
      texts.push_back(question.text);
    return texts;
  }
  std::vector<std::pair<double, double>> Box() const {
    std::vector<std::pair<double, double>> box;
    for (const Interval& interval : problem_.constraints.box) {
      box.emplace_back(interval.low, interval.high);
    }
    return box;
  }
  const BoundProblem& problem() const { return problem_; }

  // Returns the bounds of each expression over each box, expressions of a box side by side. `ends`
  // has the low and high end of each variable of each box.
  std::vector<BothBounds> Over(const double* ends, std::size_t boxes, const BoundRequest& request) {
    std::vector<BothBounds> all;
    algebra::ConstraintSet constraints = problem_.constraints;
    for (std::size_t i = 0; i < boxes; ++i) {
      for (Interval& interval : constraints.box) {
        interval = {ends[0], ends[1]};
        ends += 2;
      }
      for (algebra::PreparedExpression& expression : prepared_) {
        StopIfRequested();
        all.push_back(expression.Both(constraints, request));
      }
    }
    return all;
  }

 private:
  BoundProblem problem_;
  std::vector<algebra::PreparedExpression> prepared_;
};

BoundRequest RequestOf(const std::string& method, double gap, std::int64_t evaluations) {
  BoundRequest request{.gap = gap, .evaluations = evaluations};
  if (method == "termwise") request.highest = algebra::BoundingMethod::kTermwise;
  return request;
}

// Returns arrays of shape (boxes, expressions).
py::dict BoundsOver(Expressions& expressions, const Boxes& boxes, const std::string& method,
                    double gap, std::int64_t evaluations) {
  const auto variables = static_cast<py::ssize_t>(expressions.problem().constraints.box.size());
  if (boxes.ndim() != 3 || boxes.shape(1) != variables || boxes.shape(2) != 2) {
    throw py::value_error(fmt::format("boxes are an array of shape (n, {}, 2)", variables));
  }
  const auto count = static_cast<std::size_t>(boxes.shape(0));
  const double* const ends = boxes.data();
  const std::vector<BothBounds> all =
      Unlocked([&] { return expressions.Over(ends, count, RequestOf(method, gap, evaluations)); });
  const std::vector<py::ssize_t> shape = {
      boxes.shape(0), static_cast<py::ssize_t>(expressions.problem().questions.size())};
  const auto array = [&](auto value) {
    py::array_t<decltype(value(all.front()))> numbers(shape);
    std::ranges::transform(all, numbers.mutable_data(), value);
    return numbers;
  };
  py::dict dict;
  dict["inf"] = array([](const BothBounds& b) { return b.inf.value; });
  dict["sup"] = array([](const BothBounds& b) { return b.sup.value; });
  dict["gap"] = array([](const BothBounds& b) { return std::max(b.inf.gap, b.sup.gap); });
  dict["evaluations"] =
      array([](const BothBounds& b) { return b.inf.evaluations + b.sup.evaluations; });
  py::list methods;
  for (const BothBounds& b : all) {
    methods.append(std::string(Name(std::max(b.inf.method, b.sup.method))));
  }
  dict["method"] = methods;
  return dict;
}

// Returns rows (expression, "inf" or "sup", variable, cost).
std::vector<py::tuple> SharesOf(const Expressions& expressions) {
  using Row = std::tuple<std::string, const char*, std::string, double>;
  const BoundProblem& problem = expressions.problem();
  const auto rows = Unlocked([&] {
    std::vector<Row> found;
    const BoundRequest request;
    for (const BoundProblem::Question& question : problem.questions) {
      const auto add = [&](const char* bound, const std::vector<algebra::Share>& shares) {
        for (const algebra::Share& share : shares) {
          found.emplace_back(question.text, bound, problem.pool->name(share.variable), share.cost);
        }
      };
      add("inf", SharesOfInf(question.expression, problem.constraints, request));
      add("sup", SharesOfSup(question.expression, problem.constraints, request));
    }
    return found;
  });
  std::vector<py::tuple> tuples;
  for (const Row& row : rows) tuples.push_back(py::cast(row));
  return tuples;
}

}  // namespace

void AddBounds(py::module_& module) {
  py::class_<Expressions>(module, "Expressions")
      .def(py::init<const std::string&, const std::string&>(), py::arg("text"), py::arg("name"))
      .def_property_readonly("variables", &Expressions::Variables)
      .def_property_readonly("texts", &Expressions::Texts)
      .def_property_readonly("box", &Expressions::Box)
      .def("bounds", BoundsOver, py::arg("boxes"), py::arg("method"), py::arg("gap"),
           py::arg("evaluations"))
      .def("shares", SharesOf);
}

}  // namespace assay::python
