#include "planner/contingent/world_sets/decision_diagram.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace assay::contingent {
namespace {

constexpr std::size_t kComputedPlaces = 1U << 17U;

std::uint64_t Hash(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return MixedHash(MixedHash(MixedHash(1, a), b), c);
}

bool ByVariable(const Assignment& a, const Assignment& b) {
  return a.variable != b.variable ? a.variable < b.variable : a.value < b.value;
}

}  // namespace

DecisionDiagrams::DecisionDiagrams() : computed_(kComputedPlaces) {
  // The two constants come after all variables.
  constexpr int kLast = std::numeric_limits<int>::max();
  nodes_ = {{kLast, 0, 0}, {kLast, 1, 1}};
}

Diagram DecisionDiagrams::Make(int variable, Diagram low, Diagram high) {
  if (low == high) return low;
  const std::uint64_t hash = Hash(variable, low, high);
  const int found = unique_.Find(hash, [&](int index) {
    const Node& node = nodes_[index];
    return node.variable == variable && node.low == low && node.high == high;
  });
  if (found >= 0) return found;
  const auto made = static_cast<Diagram>(nodes_.size());
  nodes_.push_back({variable, low, high});
  unique_.Insert(hash, made);
  return made;
}

Diagram DecisionDiagrams::Literal(Assignment literal) {
  return Make(literal.variable, literal.value ? kEmptySet : kAllSets,
              literal.value ? kAllSets : kEmptySet);
}

Diagram DecisionDiagrams::Branch(Diagram f, int variable, bool value) const {
  const Node& node = nodes_[f];
  if (node.variable != variable) return f;
  return value ? node.high : node.low;
}

Diagram DecisionDiagrams::IfThenElse(Diagram f, Diagram g, Diagram h) {
  if (f == kAllSets) return g;
  if (f == kEmptySet) return h;
  if (g == h) return g;
  if (g == kAllSets && h == kEmptySet) return f;
  const std::size_t place = Hash(f, g, h) >> 20U & (kComputedPlaces - 1);
  if (const Computed& c = computed_[place]; c.f == f && c.g == g && c.h == h) return c.result;
  const int top = std::min({variable(f), variable(g), variable(h)});
  const auto branch = [&](bool value) {
    return IfThenElse(Branch(f, top, value), Branch(g, top, value), Branch(h, top, value));
  };
  const Diagram low = branch(false);
  const Diagram high = branch(true);
  const Diagram result = Make(top, low, high);
  computed_[place] = {f, g, h, result};
  return result;
}

bool DecisionDiagrams::Implies(Diagram f, Diagram g) const {
  std::unordered_set<std::uint64_t> implied;
  return ImpliesBesides(f, g, implied);
}

// `implied` contains the pairs that are proved. The first counterexample ends the search.
bool DecisionDiagrams::ImpliesBesides(Diagram f, Diagram g,
                                      std::unordered_set<std::uint64_t>& implied) const {
  if (f == kEmptySet || g == kAllSets || f == g) return true;
  if (g == kEmptySet || f == kAllSets) return false;
  const std::uint64_t pair = static_cast<std::uint64_t>(f) << 32U | static_cast<std::uint32_t>(g);
  if (implied.contains(pair)) return true;
  const int top = std::min(variable(f), variable(g));
  for (const bool value : {false, true}) {
    if (!ImpliesBesides(Branch(f, top, value), Branch(g, top, value), implied)) return false;
  }
  implied.insert(pair);
  return true;
}

Diagram DecisionDiagrams::ExactlyOne(std::span<const Assignment> literals) {
  Diagram none = kAllSets;
  Diagram one = kEmptySet;
  for (const Assignment& literal : literals) {
    const Diagram holds = Literal(literal);
    one = IfThenElse(holds, none, one);
    none = And(none, Not(holds));
  }
  return one;
}

Diagram DecisionDiagrams::AtLeastOne(std::span<const Assignment> literals) {
  Diagram some = kEmptySet;
  for (const Assignment& literal : literals) some = Or(some, Literal(literal));
  return some;
}

Diagram DecisionDiagrams::Restrict(Diagram f, const std::vector<Assignment>& literals) {
  std::unordered_map<Diagram, Diagram> done;
  return RestrictFrom(f, literals, done);
}

Diagram DecisionDiagrams::RestrictFrom(Diagram f, std::span<const Assignment> literals,
                                       std::unordered_map<Diagram, Diagram>& done) {
  const int top = variable(f);
  while (!literals.empty() && literals.front().variable < top) literals = literals.subspan(1);
  if (IsConstant(f) || literals.empty()) return f;
  if (literals.front().variable == top) {
    return RestrictFrom(literals.front().value ? high(f) : low(f), literals.subspan(1), done);
  }
  if (const auto found = done.find(f); found != done.end()) return found->second;
  const Diagram if_false = RestrictFrom(low(f), literals, done);
  const Diagram if_true = RestrictFrom(high(f), literals, done);
  return done[f] = Make(top, if_false, if_true);
}

Diagram DecisionDiagrams::Compose(Diagram f, const std::unordered_map<int, Diagram>& of) {
  std::unordered_map<Diagram, Diagram> done;
  return ComposeWith(f, of, done);
}

Diagram DecisionDiagrams::ComposeWith(Diagram f, const std::unordered_map<int, Diagram>& of,
                                      std::unordered_map<Diagram, Diagram>& done) {
  if (IsConstant(f)) return f;
  if (const auto found = done.find(f); found != done.end()) return found->second;
  const Node node = nodes_[f];
  const Diagram low = ComposeWith(node.low, of, done);
  const Diagram high = ComposeWith(node.high, of, done);
  const auto replacement = of.find(node.variable);
  const Diagram test =
      replacement != of.end() ? replacement->second : Literal({node.variable, true});
  return done[f] = IfThenElse(test, high, low);
}

Diagram DecisionDiagrams::Exists(Diagram f, int variable) {
  return Or(Cofactor(f, {variable, false}), Cofactor(f, {variable, true}));
}

Diagram DecisionDiagrams::ForAll(Diagram f, int variable) {
  return And(Cofactor(f, {variable, false}), Cofactor(f, {variable, true}));
}

const std::vector<Assignment>& DecisionDiagrams::Essential(Diagram f) {
  if (const auto found = essential_.find(f); found != essential_.end()) return found->second;
  std::vector<Assignment> literals;
  if (!IsConstant(f)) {
    const Node node = nodes_[f];
    if (node.low == kEmptySet || node.high == kEmptySet) {
      const bool value = node.low == kEmptySet;
      literals = Essential(value ? node.high : node.low);
      literals.insert(literals.begin(), {node.variable, value});
    } else {
      const std::vector<Assignment>& low = Essential(node.low);
      const std::vector<Assignment>& high = Essential(node.high);
      std::set_intersection(low.begin(), low.end(), high.begin(), high.end(),
                            std::back_inserter(literals), ByVariable);
    }
  }
  return essential_[f] = std::move(literals);
}

const std::vector<int>& DecisionDiagrams::Support(Diagram f) {
  const auto [entry, is_new] = support_.try_emplace(f);
  if (!is_new) return entry->second;
  std::vector<int>& variables = entry->second;
  marks_.resize(nodes_.size(), 0);
  ++mark_;
  std::vector<Diagram> open = {f};
  while (!open.empty()) {
    const Diagram next = open.back();
    open.pop_back();
    if (IsConstant(next) || std::exchange(marks_[next], mark_) == mark_) continue;
    variables.push_back(variable(next));
    open.push_back(low(next));
    open.push_back(high(next));
  }
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  return variables;
}

}  // namespace assay::contingent
