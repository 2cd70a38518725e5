#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"

namespace assay::peers {

// Z3's solver of finite domains (QF_FD) on a binary constraint network: one Boolean a label, and
// the clauses of bench/peers/cadical_labeling.h.
class Z3Labeling {
 public:
  enum class Encoding { kDirect, kSupport };
  static constexpr Encoding kEncodings[] = {Encoding::kDirect, Encoding::kSupport};
  static std::string_view Name(Encoding encoding);  // as contestant

  // Gives the solver all clauses, in its own form. A solver answers once: First is to be asked of a
  // new one.
  Z3Labeling(const workloads::NetworkWorkload& workload, Encoding encoding);
  ~Z3Labeling();

  LabelingAnswer First(double seconds);

  // As CadicalLabeling::PostArcByArc.
  static std::vector<Outcome> PostArcByArc(const workloads::NetworkWorkload& workload,
                                           Encoding encoding, double seconds);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace assay::peers
