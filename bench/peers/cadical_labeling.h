#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"

namespace assay::peers {

// CaDiCaL on a binary constraint network: one Boolean a label, one clause "some label" and the
// pairs "not two labels" a node. Arcs as clauses against forbidden pairs (direct encoding), or
// "if this label, then one of its supports" in both directions (support encoding: Gent 2002).
class CadicalLabeling {
 public:
  enum class Encoding { kDirect, kSupport };
  static constexpr Encoding kEncodings[] = {Encoding::kDirect, Encoding::kSupport};
  static std::string_view Name(Encoding encoding);  // as contestant

  // Gives the solver all clauses. A solver answers once: First is to be asked of a new one.
  CadicalLabeling(const workloads::NetworkWorkload& workload, Encoding encoding);
  ~CadicalLabeling();

  LabelingAnswer First(double seconds);

  // Arcs are posted one by one, in order, and taken back where they leave no labeling; whether
  // each was accepted, shorter than the arcs when the time was up. One solver answers all: the
  // clauses of the arc in question hold under an assumption, which becomes a fact, or its
  // opposite; what was learned is kept.
  static std::vector<Outcome> PostArcByArc(const workloads::NetworkWorkload& workload,
                                           Encoding encoding, double seconds);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace assay::peers
