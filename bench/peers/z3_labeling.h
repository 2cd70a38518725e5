#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"

namespace assay::peers {

// Asks Z3's solver of finite domains (QF_FD) about a binary constraint network, with one Boolean
// for each label and the clauses of bench/peers/cadical_labeling.h.
class Z3Labeling {
 public:
  enum class Encoding { kDirect, kSupport };
  static constexpr Encoding kEncodings[] = {Encoding::kDirect, Encoding::kSupport};
  static std::string_view Name(Encoding encoding);  // the contestant's name

  // Gives the solver all clauses, in its own form. A solver answers once, so First needs a new one
  // for each question.
  Z3Labeling(const workloads::NetworkWorkload& workload, Encoding encoding);
  ~Z3Labeling();

  LabelingAnswer First(double seconds);

  // Posts arcs one by one, like CadicalLabeling::PostArcByArc.
  static std::vector<Outcome> PostArcByArc(const workloads::NetworkWorkload& workload,
                                           Encoding encoding, double seconds);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace assay::peers
