#include "planner/algebra/multiaffine/multiaffine_form.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

using AtomSet = NestedForm::AtomSet;
using Factor = NormalForm::Factor;

constexpr double kUnit = 0x1p-53;    // unit of rounding
constexpr double kSlack = 1.02;      // covers products of units and roundings of the bounds
constexpr int kRoundingsOfSine = 2;  // roundings in the C library's sine or cosine

bool IsSineOrCosine(const Expression& atom) {
  return atom.op() == Operator::kSin || atom.op() == Operator::kCos;
}

class Reader {
 public:
  explicit Reader(const NormalForm& form) : normal_form_(form) {}

  std::optional<MultiaffineForm> Read() {
    for (const NormalForm::Term& term : normal_form_.terms) {
      if (!NoteVariables(term)) return std::nullopt;
    }
    ListVariables();
    if (form_.variables.empty() || form_.atom_count() > NestedForm::kMostAtoms) return std::nullopt;
    for (const NormalForm::Term& term : normal_form_.terms) Add(term);
    form_.nested.Assign(terms_);
    BoundErrors();
    return std::move(form_);
  }

 private:
  struct Use {
    bool is_angle = false;
    int terms = 0;
  };

  // Returns false if the term is not of a multi-affine form.
  bool NoteVariables(const NormalForm::Term& term) {
    seen_.clear();
    const bool is_rounding_alone = IsRoundingAlone(term.coefficient);
    for (const Factor& factor : term.factors) {
      // A sine or cosine is at most 1 for any argument.
      if (IsSineOrCosine(factor.atom) && is_rounding_alone) continue;
      const Expression inner =
          IsSineOrCosine(factor.atom) ? factor.atom.operands()[0] : factor.atom;
      if (inner.op() != Operator::kVariable || factor.exponent != 1) return false;
      if (std::ranges::find(seen_, inner.variable()) != seen_.end()) return false;
      seen_.push_back(inner.variable());
      const auto [use, is_new] = uses_.try_emplace(inner.variable(), IsSineOrCosine(factor.atom));
      if (use->second.is_angle != IsSineOrCosine(factor.atom)) return false;
      ++use->second.terms;
    }
    return true;
  }

  void ListVariables() {
    std::vector<std::pair<VariableId, Use>> uses(uses_.begin(), uses_.end());
    std::ranges::stable_sort(uses, [](const auto& a, const auto& b) {
      if (a.second.is_angle != b.second.is_angle) return a.second.is_angle;
      return a.second.terms > b.second.terms;
    });
    for (const auto& [id, use] : uses) {
      places_[id] = static_cast<int>(form_.variables.size());
      form_.variables.push_back({id, use.is_angle});
      if (use.is_angle) ++form_.angle_count;
    }
  }

  void Add(const NormalForm::Term& term) {
    AtomSet atoms = 0;
    AtomSet displacements = 0;
    const bool is_rounding_alone = IsRoundingAlone(term.coefficient);
    for (const Factor& factor : term.factors) {
      if (!IsSineOrCosine(factor.atom)) {
        displacements |= NestedForm::SetOf(form_.AtomOf(places_.at(factor.atom.variable())));
      } else if (!is_rounding_alone) {
        const int cosine = form_.AtomOf(places_.at(factor.atom.operands()[0].variable()));
        const bool is_sine = factor.atom.op() == Operator::kSin;
        atoms |= NestedForm::SetOf(is_sine ? cosine + 1 : cosine);
      }
    }
    const double centre = is_rounding_alone ? 0 : Midpoint(term.coefficient);
    if (centre != 0) terms_.push_back({atoms | displacements, centre});
    Magnitude& magnitude = magnitudes_[displacements];
    magnitude.of_centres += std::abs(centre);
    const Interval deviation = term.coefficient - Interval{centre, centre};
    magnitude.of_deviations += std::max(-deviation.low, deviation.high);
  }

  void BoundErrors() {
    const auto terms = static_cast<int>(terms_.size());
    const auto variables = static_cast<int>(form_.variables.size());
    form_.point_error = ErrorAfter(RoundingsOfValue() + 1);
    // The roundings come from merging terms after coordinates are known, adding terms, multiplying
    // them by the factors of their nodes, and from the derivatives of these factors along a
    // tangent.
    form_.error = ErrorAfter(8 * (terms + variables) + 64);
  }

  NestedForm ErrorAfter(int roundings) const {
    std::vector<NestedForm::Term> terms;
    for (const auto& [displacements, magnitude] : magnitudes_) {
      const double error = roundings * kUnit * magnitude.of_centres + magnitude.of_deviations;
      terms.push_back({displacements, kSlack * error});
    }
    NestedForm form;
    form.Assign(terms);
    return form;
  }

  // Returns the number of roundings on the longest path of a term through NestedEvaluation::Value.
  int RoundingsOfValue() const {
    std::vector<int> roundings;
    for (int node = 0; node < form_.nested.node_count(); ++node) {
      int most = 0;
      const auto note = [&](int atom, int of_rest) {
        const bool is_sine_or_cosine = atom < 2 * form_.angle_count;
        most = std::max(most, of_rest + 1 + (is_sine_or_cosine ? kRoundingsOfSine : 0));
      };
      const auto leaves = form_.nested.leaves(node);
      const auto branches = form_.nested.branches(node);
      for (const auto& leaf : leaves) note(leaf.atom, 0);
      for (const auto& branch : branches) note(branch.atom, roundings[branch.node]);
      roundings.push_back(most + static_cast<int>(leaves.size() + branches.size()));
    }
    return roundings.back();
  }

  struct Magnitude {
    double of_centres = 0;
    double of_deviations = 0;
  };

  const NormalForm& normal_form_;
  MultiaffineForm form_;
  std::vector<VariableId> seen_;  // scratch: the variables of the term that is being read
  std::vector<NestedForm::Term> terms_;
  std::map<VariableId, Use> uses_;
  std::map<VariableId, int> places_;  // places in the form's variables
  // The magnitudes of the terms, summed over the terms that have the same displacements as factors.
  // The key is the set of these displacements.
  std::map<AtomSet, Magnitude> magnitudes_;
};

}  // namespace

std::optional<MultiaffineForm> MultiaffineFormOf(const NormalForm& form) {
  return Reader(form).Read();
}

}  // namespace assay::algebra
