#pragma once

#include <glpk.h>
#include <gmpxx.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "planner/base/interval.h"

// Solves linear programs by GLPK's simplex method in rational arithmetic. GLPK gives the bounds and
// rows on which the optimum lies. GLPK's numbers are rounded, so the optimal point is computed from
// these bounds and rows in rational numbers. The oracle can be trusted for small systems.
namespace assay::oracle {

struct LinearProgram {
  struct Row {
    std::vector<double> coefficients;  // one for each variable
    double upper = 0;                  // the sum is at most this
  };
  std::vector<Interval> box;  // ends may be infinite
  std::vector<Row> rows;
  std::vector<double> objective;  // one for each variable
};

struct Maximum {
  enum class Kind { kFinite, kUnbounded, kContradiction } kind = Kind::kContradiction;
  mpq_class value = {};  // set if `kind` is kFinite
};

// RoundedUp returns the least double that is not below q. RoundedDown returns the greatest double
// that is not above q.
inline double RoundedUp(const mpq_class& q) {
  const double near = q.get_d();
  return near < q ? std::nextafter(near, std::numeric_limits<double>::infinity()) : near;
}
inline double RoundedDown(const mpq_class& q) { return -RoundedUp(-q); }

// The equation a1*x1 + ... = right, as the row a1, ..., right.
using Equation = std::vector<mpq_class>;

// Returns the solution of as many independent equations as there are unknowns.
inline std::vector<mpq_class> Solve(std::vector<Equation> equations) {
  const std::size_t n = equations.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (equations[pivot][k] == 0) ++pivot;
    std::swap(equations[k], equations[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const mpq_class factor = equations[i][k] / equations[k][k];
      for (std::size_t j = 0; j <= n; ++j) equations[i][j] -= factor * equations[k][j];
    }
  }
  std::vector<mpq_class> solution;
  for (std::size_t k = 0; k < n; ++k) solution.push_back(equations[k][n] / equations[k][k]);
  return solution;
}

// Returns the bounds and rows on which GLPK's optimum lies, as equations.
inline std::vector<Equation> TightEquations(const LinearProgram& program, glp_prob* p) {
  const std::size_t n = program.box.size();
  std::vector<Equation> equations;
  for (std::size_t v = 0; v < n; ++v) {
    const int status = glp_get_col_stat(p, static_cast<int>(v) + 1);
    if (status == GLP_BS) continue;
    Equation equation(n + 1);
    equation[v] = 1;
    if (status == GLP_NL || status == GLP_NS) equation[n] = program.box[v].low;
    if (status == GLP_NU) equation[n] = program.box[v].high;
    equations.push_back(equation);
  }
  for (std::size_t i = 0; i < program.rows.size(); ++i) {
    if (glp_get_row_stat(p, static_cast<int>(i) + 1) == GLP_BS) continue;
    const LinearProgram::Row& row = program.rows[i];
    Equation equation(row.coefficients.begin(), row.coefficients.end());
    equation.emplace_back(row.upper);
    equations.push_back(equation);
  }
  return equations;
}

inline int GlpkBoundType(const Interval& interval) {
  const bool below = interval.low > -std::numeric_limits<double>::infinity();
  const bool above = interval.high < std::numeric_limits<double>::infinity();
  if (!below) return above ? GLP_UP : GLP_FR;
  if (!above) return GLP_LO;
  return interval.low == interval.high ? GLP_FX : GLP_DB;
}

inline Maximum Maximize(const LinearProgram& program) {
  const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem(glp_create_prob(),
                                                                      &glp_delete_prob);
  glp_prob* const p = problem.get();
  const int variables = static_cast<int>(program.box.size());
  glp_term_out(GLP_OFF);
  glp_set_obj_dir(p, GLP_MAX);
  glp_add_cols(p, variables);
  for (int v = 1; v <= variables; ++v) {
    const Interval& ends = program.box[v - 1];
    glp_set_col_bnds(p, v, GlpkBoundType(ends), ends.low, ends.high);
    glp_set_obj_coef(p, v, program.objective[v - 1]);
  }
  std::vector<int> indices(variables + 1);
  for (int v = 1; v <= variables; ++v) indices[v] = v;
  for (const LinearProgram::Row& row : program.rows) {
    const int i = glp_add_rows(p, 1);
    std::vector<double> coefficients = {0};  // GLPK counts from 1
    coefficients.insert(coefficients.end(), row.coefficients.begin(), row.coefficients.end());
    glp_set_row_bnds(p, i, GLP_UP, 0, row.upper);
    glp_set_mat_row(p, i, variables, indices.data(), coefficients.data());
  }
  glp_exact(p, nullptr);
  Maximum maximum;
  if (glp_get_status(p) == GLP_UNBND) maximum.kind = Maximum::Kind::kUnbounded;
  if (glp_get_status(p) != GLP_OPT) return maximum;
  maximum.kind = Maximum::Kind::kFinite;
  const std::vector<mpq_class> point = Solve(TightEquations(program, p));
  for (int v = 0; v < variables; ++v) maximum.value += program.objective[v] * point[v];
  return maximum;
}

}  // namespace assay::oracle
