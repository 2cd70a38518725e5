#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"

namespace assay::peers {

// Asks CaDiCaL about a binary constraint network. Each label is one Boolean. Each node has one
// clause "some label" and clauses "not two labels" for all pairs. Arcs are clauses against
// forbidden pairs (direct encoding), or clauses "if this label, then one of its supports" in both
// directions (support encoding: Gent 2002).
class CadicalLabeling {
 public:
  enum class Encoding { kDirect, kSupport };
  static constexpr Encoding kEncodings[] = {Encoding::kDirect, Encoding::kSupport};
  static std::string_view Name(Encoding encoding);  // the contestant's name

  // Gives the solver all clauses. A solver answers once, so First needs a new one for each
  // question.
  CadicalLabeling(const workloads::NetworkWorkload& workload, Encoding encoding);
  ~CadicalLabeling();

  LabelingAnswer First(double seconds);

  // Posts arcs one by one, in order, and takes back those that leave no labeling. Returns for each
  // arc whether it was accepted; the result is shorter than the arcs if the time was up. One solver
  // gives all answers and keeps the clauses it has learned. The clauses of the arc in question hold
  // under an assumption. The assumption, or its negation, becomes a fact afterwards.
  static std::vector<Outcome> PostArcByArc(const workloads::NetworkWorkload& workload,
                                           Encoding encoding, double seconds);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace assay::peers
