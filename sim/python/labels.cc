#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/network/constraint_network/network_file.h"
#include "planner/network/labeling/count.h"
#include "planner/network/labeling/search.h"
#include "sim/cli/command_line/exit_code.h"
#include "sim/python/module.h"
#include "sim/python/unlocked.h"

namespace assay::python {
namespace {

namespace py = pybind11;
using network::LabelRequest;
using Allowed = py::array_t<bool, py::array::c_style | py::array::forcecast>;
// The first node, the second node, and the allowed pairs: rows are labels of the first node.
using ArrayArc = std::tuple<int, int, Allowed>;

std::shared_ptr<const network::Relation> RelationOf(const Allowed& allowed) {
  const auto matrix = allowed.unchecked<2>();
  return network::Relation::Where(
      static_cast<int>(allowed.shape(0)), static_cast<int>(allowed.shape(1)),
      [&](network::Label row, network::Label column) { return matrix(row, column); });
}

// Returns the network whose nodes have these numbers of labels. Labels are named by their numbers.
network::NamedNetwork NetworkOf(const std::vector<int>& counts, const std::vector<ArrayArc>& arcs) {
  network::NamedNetwork named;
  for (const int count : counts) {
    named.network.AddNode(network::LabelSet::All(count));
    named.nodes.push_back(std::to_string(named.nodes.size()));
    std::vector<std::string>& labels = named.labels.emplace_back();
    for (int label = 0; label < count; ++label) labels.push_back(std::to_string(label));
  }
  for (const auto& [a, b, allowed] : arcs) {
    named.network.AddArc(network::NodeId(a), network::NodeId(b), RelationOf(allowed));
  }
  return named;
}

py::dict Labeled(const network::NamedNetwork& named, int request, std::int64_t limit) {
  const network::LabelReport report = Unlocked([&] {
    Budget budget(limit);
    return network::LabelNetwork(named, static_cast<LabelRequest>(request), budget);
  });
  py::dict dict;
  dict["outcome"] = static_cast<int>(cli::ExitCodeOf(report.outcome));
  py::list labelings;
  for (const network::NamedLabeling& labeling : report.labelings) {
    py::dict labels;
    for (const auto& [node, label] : labeling) labels[py::str(node)] = label;
    labelings.append(labels);
  }
  dict["labelings"] = labelings;
  dict["count"] = report.count;
  dict["or_more"] = report.count == network::kManyLabelings;
  dict["visited"] = report.counters.visited;
  return dict;
}

}  // namespace

void AddLabels(py::module_& module) {
  py::class_<network::NamedNetwork>(module, "Network")
      .def(py::init([](const std::string& text, const std::string& name) {
             return network::ReadNetwork(Document::Parse(text, name));
           }),
           py::arg("text"), py::arg("name"))
      .def(py::init(&NetworkOf), py::arg("counts"), py::arg("arcs"))
      .def("label", Labeled, py::arg("request"), py::arg("budget"));
  module.def(
      "load_network", [](const std::string& file) { return network::LoadNetwork(file); },
      py::arg("file"));
  module.attr("MOST_LABELS") = network::kMaxLabels;
}

}  // namespace assay::python
