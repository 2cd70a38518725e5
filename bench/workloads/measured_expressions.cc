#include "bench/workloads/measured_expressions.h"

#include <utility>

#include "planner/base/input_files/document.h"

namespace assay::workloads {
namespace {

std::vector<algebra::Expression> WavesOf(const Value& angles, algebra::ExpressionPool& pool) {
  std::vector<algebra::Expression> waves;
  for (const Value& name : angles.Items()) {
    const auto angle = pool.Find(name.Text());
    if (!angle) name.Fail("there is no variable '" + name.Text() + "'", "one of the expression's");
    waves.push_back(Sin(pool.Variable(*angle)));
    waves.push_back(Cos(pool.Variable(*angle)));
  }
  return waves;
}

}  // namespace

std::vector<MeasuredExpression> LoadMeasuredExpressions(const std::filesystem::path& folder) {
  const Document table = Document::Load(folder / "measured.yaml");
  table.RequireFormat("measured-expressions");
  std::vector<MeasuredExpression> expressions;
  for (const auto& [name, row] : table.root().At("expressions").Entries()) {
    row.AllowOnly({"angles", "range", "boost_us", "ibex_ms"});
    const std::vector<double> range = row.At("range").Numbers(2);
    algebra::BoundProblem problem = algebra::LoadBoundProblem(folder / (name.Text() + ".json"));
    std::vector<algebra::Expression> waves = WavesOf(row.At("angles"), *problem.pool);
    expressions.push_back({.name = name.Text(),
                           .problem = std::move(problem),
                           .range = {range[0], range[1]},
                           .waves = std::move(waves),
                           .boost_us = row.At("boost_us").Number(),
                           .ibex_ms = row.At("ibex_ms").Number()});
  }
  return expressions;
}

}  // namespace assay::workloads
