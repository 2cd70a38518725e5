#include "bench/peers/cadical_labeling.h"

#include <cadical.hpp>

#include <initializer_list>

#include "bench/peers/processor_time.h"

namespace assay::peers {
namespace {

using network::Arc;
using network::Label;
using network::LabelSet;
using network::Relation;
using workloads::NetworkWorkload;

constexpr int kSatisfiable = 10, kUnsatisfiable = 20;  // results of CaDiCaL::Solver::solve

class Deadline : public CaDiCaL::Terminator {
 public:
  explicit Deadline(double seconds) : end_(ProcessorSeconds() + seconds) {}
  bool terminate() override { return ProcessorSeconds() >= end_; }

 private:
  double end_;
};

Outcome OutcomeOf(int status) {
  return status == kSatisfiable     ? Outcome::kFound
         : status == kUnsatisfiable ? Outcome::kNone
                                    : Outcome::kBudget;
}

}  // namespace

class CadicalLabeling::Solver {
 public:
  Solver(const std::vector<LabelSet>& nodes, Encoding encoding)
      : nodes_(nodes), encoding_(encoding) {
    solver_.set("quiet", 1);
    for (const LabelSet& labels : nodes_) {
      first_variable_.push_back(variables_ + 1);
      variables_ += labels.size();
    }
    for (int node = 0; node < std::ssize(nodes_); ++node) AddNode(node);
  }

  // Adds an arc's clauses, which hold where `switch_literal` is true. If `switch_literal` is 0, the
  // clauses always hold.
  void AddArc(const Arc& arc, int switch_literal) {
    switch (encoding_) {
      case Encoding::kDirect:
        return Forbid(arc, switch_literal);
      case Encoding::kSupport:
        Support(arc.a.index(), arc.b.index(), switch_literal,
                [&](Label row, Label column) { return arc.relation->Allows(row, column); });
        Support(arc.b.index(), arc.a.index(), switch_literal,
                [&](Label column, Label row) { return arc.relation->Allows(row, column); });
        return;
    }
  }

  int AddSwitch() { return ++variables_; }
  void Assume(int literal) { solver_.assume(literal); }
  void AddUnit(int literal) { AddClause({literal}); }

  Outcome Solve(double seconds) {
    Deadline deadline(seconds);
    solver_.connect_terminator(&deadline);
    const Outcome outcome = OutcomeOf(solver_.solve());
    solver_.disconnect_terminator();
    return outcome;
  }

  network::Labeling labeling() {
    network::Labeling labeling;
    for (int node = 0; node < std::ssize(nodes_); ++node) {
      for (Label label : nodes_[node]) {
        if (solver_.val(Literal(node, label)) > 0) labeling.labels.push_back(label);
      }
    }
    return labeling;
  }

 private:
  int Literal(int node, Label label) const { return first_variable_[node] + label; }

  void AddNode(int node) {
    for (Label label : nodes_[node]) solver_.add(Literal(node, label));
    solver_.add(0);
    for (Label a : nodes_[node]) {
      for (Label b : nodes_[node]) {
        if (a < b) AddClause({-Literal(node, a), -Literal(node, b)});
      }
    }
  }

  void AddClause(std::initializer_list<int> literals) {
    for (int literal : literals) solver_.add(literal);
    solver_.add(0);
  }

  void AddSwitched(int switch_literal) {
    if (switch_literal != 0) solver_.add(-switch_literal);
  }

  void Forbid(const Arc& arc, int switch_literal) {
    for (Label row : nodes_[arc.a.index()]) {
      for (Label column : nodes_[arc.b.index()]) {
        if (arc.relation->Allows(row, column)) continue;
        AddSwitched(switch_literal);
        solver_.add(-Literal(arc.a.index(), row));
        solver_.add(-Literal(arc.b.index(), column));
        solver_.add(0);
      }
    }
  }

  template <class Allows>
  void Support(int node, int other, int switch_literal, const Allows& allows) {
    for (Label label : nodes_[node]) {
      AddSwitched(switch_literal);
      solver_.add(-Literal(node, label));
      for (Label support : nodes_[other]) {
        if (allows(label, support)) solver_.add(Literal(other, support));
      }
      solver_.add(0);
    }
  }

  CaDiCaL::Solver solver_;
  std::vector<LabelSet> nodes_;
  Encoding encoding_;
  std::vector<int> first_variable_;
  int variables_ = 0;
};

std::string_view CadicalLabeling::Name(Encoding encoding) {
  return encoding == Encoding::kDirect ? "cadical:direct" : "cadical:support";
}

CadicalLabeling::CadicalLabeling(const NetworkWorkload& workload, Encoding encoding)
    : solver_(std::make_unique<Solver>(workload.nodes, encoding)) {
  for (const Arc& arc : workload.arcs) solver_->AddArc(arc, 0);
}

CadicalLabeling::~CadicalLabeling() = default;

LabelingAnswer CadicalLabeling::First(double seconds) {
  LabelingAnswer answer;
  answer.outcome = solver_->Solve(seconds);
  if (answer.outcome == Outcome::kFound) answer.labeling = solver_->labeling();
  return answer;
}

std::vector<Outcome> CadicalLabeling::PostArcByArc(const NetworkWorkload& workload,
                                                   Encoding encoding, double seconds) {
  const double end = ProcessorSeconds() + seconds;
  std::vector<Outcome> outcomes;
  Solver solver(workload.nodes, encoding);
  for (const Arc& arc : workload.arcs) {
    const int posted = solver.AddSwitch();
    solver.AddArc(arc, posted);
    solver.Assume(posted);
    const Outcome outcome = solver.Solve(end - ProcessorSeconds());
    if (outcome == Outcome::kBudget) return outcomes;
    outcomes.push_back(outcome);
    solver.AddUnit(outcome == Outcome::kFound ? posted : -posted);
  }
  return outcomes;
}

}  // namespace assay::peers
