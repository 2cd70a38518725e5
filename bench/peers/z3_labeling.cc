#include "bench/peers/z3_labeling.h"

#include <z3++.h>

#include <algorithm>

#include "bench/peers/processor_time.h"

namespace assay::peers {
namespace {

using network::Arc;
using network::Label;
using network::LabelSet;
using workloads::NetworkWorkload;

Outcome OutcomeOf(z3::check_result result) {
  switch (result) {
    case z3::sat:
      return Outcome::kFound;
    case z3::unsat:
      return Outcome::kNone;
    case z3::unknown:
      return Outcome::kBudget;
  }
  return Outcome::kBudget;
}

}  // namespace

class Z3Labeling::Solver {
 public:
  Solver(const std::vector<LabelSet>& nodes, Encoding encoding)
      : solver_(context_, "QF_FD"), nodes_(nodes), encoding_(encoding) {
    for (const LabelSet& labels : nodes_) AddNode(labels);
  }

  // Adds an arc's clauses, which hold where `condition` is true.
  void AddArc(const Arc& arc, const z3::expr& condition) {
    const int a = arc.a.index(), b = arc.b.index();
    switch (encoding_) {
      case Encoding::kDirect:
        return Forbid(arc, condition);
      case Encoding::kSupport:
        Support(a, b, condition,
                [&](Label row, Label column) { return arc.relation->Allows(row, column); });
        Support(b, a, condition,
                [&](Label column, Label row) { return arc.relation->Allows(row, column); });
        return;
    }
  }

  z3::expr Always() { return context_.bool_val(true); }
  z3::expr AddSwitch() { return NewBoolean(); }
  void AddFact(const z3::expr& fact) { solver_.add(fact); }

  // Makes the clauses. Z3 turns what was added into clauses only when a scope is entered or a
  // question is asked.
  void MakeClauses() { solver_.push(); }

  // Solves under an assumption. Z3 counts seconds of the wall clock.
  Outcome Solve(const z3::expr& assumption, double seconds) {
    solver_.set("timeout", static_cast<unsigned>(std::max(1.0, 1e3 * seconds)));
    z3::expr_vector assumptions(context_);
    if (!assumption.is_true()) assumptions.push_back(assumption);
    return OutcomeOf(solver_.check(assumptions));
  }

  network::Labeling labeling() const {
    const z3::model model = solver_.get_model();
    network::Labeling labeling;
    for (int node = 0; node < std::ssize(nodes_); ++node) {
      for (Label label : nodes_[node]) {
        if (model.eval(Literal(node, label)).is_true()) labeling.labels.push_back(label);
      }
    }
    return labeling;
  }

 private:
  const z3::expr& Literal(int node, Label label) const { return literals_[node][label]; }

  z3::expr NewBoolean() {
    return z3::expr(context_, Z3_mk_fresh_const(context_, "b", context_.bool_sort()));
  }

  void AddNode(const LabelSet& labels) {
    std::vector<z3::expr>& literals = literals_.emplace_back();
    z3::expr_vector some(context_);
    for (Label label : labels) {
      literals.resize(label + 1, Always());
      some.push_back(literals.back() = NewBoolean());
    }
    solver_.add(z3::mk_or(some));
    for (unsigned a = 0; a < some.size(); ++a) {
      for (unsigned b = a + 1; b < some.size(); ++b) solver_.add(!some[a] || !some[b]);
    }
  }

  void AddClause(z3::expr_vector& literals, const z3::expr& condition) {
    if (!condition.is_true()) literals.push_back(!condition);
    solver_.add(z3::mk_or(literals));
  }

  void Forbid(const Arc& arc, const z3::expr& condition) {
    for (Label row : nodes_[arc.a.index()]) {
      for (Label column : nodes_[arc.b.index()]) {
        if (arc.relation->Allows(row, column)) continue;
        z3::expr_vector clause(context_);
        clause.push_back(!Literal(arc.a.index(), row));
        clause.push_back(!Literal(arc.b.index(), column));
        AddClause(clause, condition);
      }
    }
  }

  template <class Allows>
  void Support(int node, int other, const z3::expr& condition, const Allows& allows) {
    for (Label label : nodes_[node]) {
      z3::expr_vector clause(context_);
      clause.push_back(!Literal(node, label));
      for (Label support : nodes_[other]) {
        if (allows(label, support)) clause.push_back(Literal(other, support));
      }
      AddClause(clause, condition);
    }
  }

  z3::context context_;
  z3::solver solver_;
  std::vector<LabelSet> nodes_;
  Encoding encoding_;
  std::vector<std::vector<z3::expr>> literals_;  // Booleans by node and label
};

std::string_view Z3Labeling::Name(Encoding encoding) {
  return encoding == Encoding::kDirect ? "z3:direct" : "z3:support";
}

Z3Labeling::Z3Labeling(const NetworkWorkload& workload, Encoding encoding)
    : solver_(std::make_unique<Solver>(workload.nodes, encoding)) {
  for (const Arc& arc : workload.arcs) solver_->AddArc(arc, solver_->Always());
  solver_->MakeClauses();
}

Z3Labeling::~Z3Labeling() = default;

LabelingAnswer Z3Labeling::First(double seconds) {
  LabelingAnswer answer;
  answer.outcome = solver_->Solve(solver_->Always(), seconds);
  if (answer.outcome == Outcome::kFound) answer.labeling = solver_->labeling();
  return answer;
}

std::vector<Outcome> Z3Labeling::PostArcByArc(const NetworkWorkload& workload, Encoding encoding,
                                              double seconds) {
  const double end = ProcessorSeconds() + seconds;
  std::vector<Outcome> outcomes;
  Solver solver(workload.nodes, encoding);
  for (const Arc& arc : workload.arcs) {
    const z3::expr posted = solver.AddSwitch();
    solver.AddArc(arc, posted);
    const Outcome outcome = solver.Solve(posted, end - ProcessorSeconds());
    if (outcome == Outcome::kBudget) return outcomes;
    outcomes.push_back(outcome);
    solver.AddFact(outcome == Outcome::kFound ? posted : !posted);
  }
  return outcomes;
}

}  // namespace assay::peers
