#pragma once

#include <glpk.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

// Finds all sets of primitive contacts that can touch together, by linear programs. For each
// contact a linear program states one of three cases: the contact touches, its gap is positive, or
// one of its limits is exceeded. Every combination of cases is tried, unless some cases of the
// combination are already impossible together.
namespace assay::oracle {

using finemotion::HalfSpace;
using finemotion::kPoseDimensions;
using finemotion::PrimitiveContact;

class FeasibleContacts {
 public:
  // Considers poses whose six scaled coordinates (d, radius w) are in [-reach, reach] metres.
  FeasibleContacts(const std::vector<PrimitiveContact>& contacts, double reach, double radius)
      : reach_(reach), radius_(radius) {
    for (std::size_t i = 0; i < contacts.size(); ++i) AddContact(contacts[i], static_cast<int>(i));
    CloseEnds();
  }

  // Returns the sets. If several contacts lie on one C-surface, a set has only the first of them.
  std::set<std::vector<int>> All() {
    all_.clear();
    Decide(0, {});
    return all_;
  }

  // Returns the least margin to a strict inequality over all programs with a solution, if it
  // decided something, in metres. `programs` is the number of programs.
  double least_margin() const { return least_margin_; }
  int programs() const { return programs_; }

 private:
  // A condition a . x <= b or a . x = b. A strict condition has a margin, which is maximized.
  struct Condition {
    Eigen::VectorXd a;
    double b = 0;
    enum class Kind { kEqual, kAtMost, kBelow } kind = Kind::kAtMost;
  };
  using Conditions = std::vector<Condition>;
  using Clause = std::vector<Conditions>;  // one set of conditions must hold completely

  struct Limit {
    Eigen::VectorXd a;
    double b = 0;
    bool open = false;  // the end of a face or edge beyond which no other face rises
  };
  using Patch = std::vector<Limit>;

  struct Surface {
    int first_contact = 0;
    Condition gap_is_0;
    std::vector<Patch> patches;
  };

  static constexpr double kLeastMargin = 1e-7;  // metres

  Eigen::VectorXd Scaled(const Eigen::VectorXd& a) const {
    Eigen::VectorXd scaled = a.head(kPoseDimensions);
    scaled.tail<3>() /= radius_;
    return scaled;
  }

  static bool AreOpposite(const Eigen::VectorXd& a, double b, const Eigen::VectorXd& other_a,
                          double other_b) {
    return (a + other_a).norm() < 1e-9 && std::abs(b + other_b) < 1e-9;
  }

  void AddContact(const PrimitiveContact& contact, int index) {
    const Eigen::VectorXd row = Scaled(contact.row);
    Surface* surface = nullptr;
    for (Surface& other : surfaces_) {
      if (AreOpposite(-row, contact.offset, other.gap_is_0.a, other.gap_is_0.b)) surface = &other;
    }
    if (surface == nullptr) {
      surface = &surfaces_.emplace_back();
      surface->first_contact = index;
      surface->gap_is_0 = {row, -contact.offset, Condition::Kind::kEqual};
    }
    surface->patches.emplace_back();
    for (const HalfSpace& limit : contact.limits) {
      const bool turn = limit.a.head<3>().isZero(0);
      surface->patches.back().push_back({(turn ? radius_ : 1) * Scaled(limit.a), limit.b, !turn});
    }
  }

  // An end belongs to a patch if everything past it is behind another surface. The end can just be
  // reached if it is in front of all surfaces.
  void CloseEnds() {
    for (Surface& surface : surfaces_) {
      Conditions in_front = {surface.gap_is_0};
      for (const Surface& other : surfaces_)
        in_front.push_back({-other.gap_is_0.a, -other.gap_is_0.b, Condition::Kind::kAtMost});
      for (Patch& patch : surface.patches) {
        for (Limit& limit : patch) {
          Conditions at_end = in_front;
          at_end.push_back({limit.a, limit.b, Condition::Kind::kEqual});
          Conditions past_end = in_front;
          past_end.push_back({-limit.a, -limit.b, Condition::Kind::kBelow});
          if (Solve(at_end, 0) && !Solve(past_end)) limit.open = false;
        }
      }
    }
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  // Returns conditions for being inside a patch, without one of its limits. If things can move
  // across a limit, the set of contacts has the dimension of its rows only if the limit is not
  // reached.
  static Conditions Inside(const Patch& patch, const Eigen::MatrixXd& free,
                           std::size_t except = kNone) {
    Conditions inside;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      if (i == except) continue;
      const bool crossed = !(free.transpose() * patch[i].a).isZero(1e-9);
      const auto kind =
          patch[i].open || crossed ? Condition::Kind::kBelow : Condition::Kind::kAtMost;
      inside.push_back({patch[i].a, patch[i].b, kind});
    }
    return inside;
  }

  static Clause Outside(const Patch& patch, std::size_t except = kNone) {
    Clause outside;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      if (i == except) continue;
      const auto kind = patch[i].open ? Condition::Kind::kAtMost : Condition::Kind::kBelow;
      outside.push_back({{-patch[i].a, -patch[i].b, kind}});
    }
    return outside;
  }

  // Calls `todo` for every edge at which two patches of the C-surface meet. The arguments are each
  // patch and the index of the limit of the patch at this edge.
  template <class Do>
  static void ForSeams(const Surface& surface, const Do& todo) {
    for (std::size_t p = 0; p < surface.patches.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q) {
        for (std::size_t i = 0; i < surface.patches[p].size(); ++i) {
          for (std::size_t j = 0; j < surface.patches[q].size(); ++j) {
            const Limit& one = surface.patches[p][i];
            const Limit& other = surface.patches[q][j];
            if (!one.open || !other.open) continue;
            if (!AreOpposite(one.a, one.b, other.a, other.b)) continue;
            todo(surface.patches[p], i, surface.patches[q], j);
          }
        }
      }
    }
  }

  static Clause Covered(const Surface& surface, const Eigen::MatrixXd& free) {
    Clause covered;
    for (const Patch& patch : surface.patches) covered.push_back(Inside(patch, free));
    ForSeams(surface, [&](const Patch& p, std::size_t i, const Patch& q, std::size_t j) {
      Conditions at_seam = Inside(p, free, i);
      const Conditions other = Inside(q, free, j);
      at_seam.insert(at_seam.end(), other.begin(), other.end());
      at_seam.push_back({p[i].a, p[i].b, Condition::Kind::kEqual});
      covered.push_back(at_seam);
    });
    return covered;
  }

  // Returns the clauses for a surface that is not touched, and that the part is not behind. All of
  // them must hold.
  static std::vector<Clause> Left(const Surface& surface) {
    using Kind = Condition::Kind;
    const Conditions in_front = {{-surface.gap_is_0.a, -surface.gap_is_0.b, Kind::kBelow}};
    std::vector<Clause> left;
    for (const Patch& patch : surface.patches) {
      left.push_back(Outside(patch));
      left.back().push_back(in_front);
    }
    ForSeams(surface, [&](const Patch& p, std::size_t i, const Patch& q, std::size_t j) {
      Clause off_seam = Outside(p, i);
      const Clause other = Outside(q, j);
      off_seam.insert(off_seam.end(), other.begin(), other.end());
      off_seam.push_back(in_front);
      off_seam.push_back({{p[i].a, p[i].b, Kind::kBelow}});
      off_seam.push_back({{q[j].a, q[j].b, Kind::kBelow}});
      left.push_back(off_seam);
    });
    return left;
  }

  // Decides sets in which exactly `touched` of the surfaces before k are touched.
  void Decide(std::size_t k, const std::vector<std::size_t>& touched) {
    if (!Satisfiable({}, Clauses(k, touched, Eigen::MatrixXd(kPoseDimensions, 0)))) return;
    if (k < surfaces_.size()) {
      std::vector<std::size_t> with = touched;
      with.push_back(k);
      Decide(k + 1, with);
      Decide(k + 1, touched);
    } else if (Satisfiable({}, Clauses(k, touched, FreeDirections(touched)))) {
      std::vector<int> contacts;
      for (const std::size_t i : touched) contacts.push_back(surfaces_[i].first_contact);
      all_.insert(contacts);
    }
  }

  std::vector<Clause> Clauses(std::size_t k, const std::vector<std::size_t>& touched,
                              const Eigen::MatrixXd& free) const {
    std::vector<Clause> clauses;
    for (std::size_t i = 0; i < k; ++i) {
      if (std::ranges::binary_search(touched, i)) {
        clauses.push_back({{surfaces_[i].gap_is_0}});
        clauses.push_back(Covered(surfaces_[i], free));
      } else {
        const std::vector<Clause> left = Left(surfaces_[i]);
        clauses.insert(clauses.end(), left.begin(), left.end());
      }
    }
    return clauses;
  }

  // Returns a basis, one vector per column, of the directions that do not change the gaps of these
  // surfaces.
  Eigen::MatrixXd FreeDirections(const std::vector<std::size_t>& touched) const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(std::ssize(touched) + 1, kPoseDimensions);
    for (std::size_t i = 0; i < touched.size(); ++i) {
      rows.row(static_cast<Eigen::Index>(i)) = surfaces_[touched[i]].gap_is_0.a;
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(rows);
    if (lu.dimensionOfKernel() == 0) return {kPoseDimensions, 0};
    return lu.kernel();
  }

  struct Solution {
    Eigen::VectorXd x;
    double margin = 0;
  };

  bool Satisfiable(const Conditions& conditions, const std::vector<Clause>& clauses) {
    const std::optional<Solution> solution = Solve(conditions);
    if (!solution) return false;
    const auto open = std::ranges::find_if(clauses, [&](const Clause& clause) {
      return std::ranges::none_of(clause,
                                  [&](const Conditions& all) { return Holds(all, *solution); });
    });
    if (open == clauses.end()) {
      least_margin_ = std::min(least_margin_, solution->margin);
      return true;
    }
    return std::ranges::any_of(*open, [&](const Conditions& all) {
      Conditions more = conditions;
      more.insert(more.end(), all.begin(), all.end());
      return Satisfiable(more, clauses);
    });
  }

  static bool Holds(const Conditions& conditions, const Solution& solution) {
    return std::ranges::all_of(conditions, [&](const Condition& condition) {
      const double excess = condition.a.dot(solution.x) - condition.b;
      switch (condition.kind) {
        case Condition::Kind::kEqual:
          return std::abs(excess) < 1e-12;
        case Condition::Kind::kAtMost:
          return excess < 1e-12;
        case Condition::Kind::kBelow:
          return excess < -kLeastMargin;
      }
      return false;
    });
  }

  // Returns the point with the greatest margin if it is large enough. Variables are in millimetres.
  std::optional<Solution> Solve(const Conditions& conditions, double least_margin = kLeastMargin) {
    ++programs_;
    const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem(glp_create_prob(),
                                                                        &glp_delete_prob);
    glp_prob* const p = problem.get();
    glp_term_out(GLP_OFF);
    glp_set_obj_dir(p, GLP_MAX);
    constexpr int kMargin = kPoseDimensions + 1;
    glp_add_cols(p, kMargin);
    for (int v = 1; v <= kPoseDimensions; ++v) {
      glp_set_col_bnds(p, v, GLP_DB, -1e3 * reach_, 1e3 * reach_);
    }
    glp_set_col_bnds(p, kMargin, GLP_DB, 0, 1e3 * reach_);
    glp_set_obj_coef(p, kMargin, 1);
    for (const Condition& condition : conditions) AddRow(condition, p);
    glp_smcp parameters;
    glp_init_smcp(&parameters);
    parameters.msg_lev = GLP_MSG_OFF;
    parameters.tol_bnd = 1e-10;
    if (glp_simplex(p, &parameters) != 0 || glp_get_status(p) != GLP_OPT) return std::nullopt;
    Solution solution{Eigen::VectorXd(kPoseDimensions), 1e-3 * glp_get_col_prim(p, kMargin)};
    for (int v = 0; v < kPoseDimensions; ++v) {
      solution.x[v] = 1e-3 * glp_get_col_prim(p, v + 1);
    }
    if (solution.margin < least_margin) return std::nullopt;
    return solution;
  }

  static void AddRow(const Condition& condition, glp_prob* p) {
    constexpr int kMargin = kPoseDimensions + 1;
    const int row = glp_add_rows(p, 1);
    const bool equal = condition.kind == Condition::Kind::kEqual;
    glp_set_row_bnds(p, row, equal ? GLP_FX : GLP_UP, 1e3 * condition.b, 1e3 * condition.b);
    std::vector<int> indices = {0};
    std::vector<double> coefficients = {0};
    for (int v = 0; v < kPoseDimensions; ++v) {
      indices.push_back(v + 1);
      coefficients.push_back(condition.a[v]);
    }
    indices.push_back(kMargin);
    coefficients.push_back(condition.kind == Condition::Kind::kBelow ? 1 : 0);
    glp_set_mat_row(p, row, kMargin, indices.data(), coefficients.data());
  }

  double reach_;
  double radius_;
  std::vector<Surface> surfaces_;
  std::set<std::vector<int>> all_;
  double least_margin_ = 1;
  int programs_ = 0;
};

}  // namespace assay::oracle
