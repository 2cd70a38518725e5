#include "bench/workloads/measured_expressions.h"

#include "planner/base/document.h"

namespace assay::workloads {

std::vector<MeasuredExpression> LoadMeasuredExpressions(const std::filesystem::path& folder) {
  const Document table = Document::Load(folder / "measured.yaml");
  table.RequireFormat("measured-expressions");
  std::vector<MeasuredExpression> expressions;
  for (const auto& [name, row] : table.root().At("expressions").Entries()) {
    row.AllowOnly({"range", "boost_us", "ibex_ms"});
    const std::vector<double> range = row.At("range").Numbers(2);
    expressions.push_back({.name = name.Text(),
                           .problem = algebra::LoadBoundProblem(folder / (name.Text() + ".json")),
                           .range = {range[0], range[1]},
                           .boost_us = row.At("boost_us").Number(),
                           .ibex_ms = row.At("ibex_ms").Number()});
  }
  return expressions;
}

}  // namespace assay::workloads
