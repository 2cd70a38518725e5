#include "sim/execution/hidden_worlds/leaves.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>

#include "planner/contingent/knowledge/knowledge_base.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/execution/hidden_worlds/fault.h"

namespace assay::execution {

using contingent::GroundLiteral;
using contingent::KnowledgeState;
using contingent::NodeId;
using contingent::PlanNode;

namespace {

// Visits the tree depth first and keeps track of what is known at each node.
class LeafSearch {
 public:
  LeafSearch(const contingent::GroundTask& task, const contingent::PlanTree& tree, std::size_t most)
      : task_(task), tree_(tree), most_(most), knowledge_(task) {}

  std::vector<Leaf> Find() {
    Visit(tree_.root, knowledge_.Initial(), {});
    return std::move(leaves_);
  }

 private:
  void Visit(NodeId id, const KnowledgeState& state, const Leaf& way) {
    const PlanNode& node = tree_.node(id);
    if (leaves_.size() >= most_) return;
    if (node.kind == PlanNode::Kind::kGoal) {
      leaves_.push_back(way);
    } else if (node.kind == PlanNode::Kind::kAct) {
      const auto after = knowledge_.After(task_.actions[node.action.index()], state);
      if (after) GoOn(node, 0, *after, way);
    } else {
      for (std::size_t child = 0; child < node.children.size(); ++child) {
        Branch(id, child, state, way);
      }
    }
  }

  void GoOn(const PlanNode& node, std::size_t child, const KnowledgeState& state, const Leaf& way) {
    if (!node.Repeats(child)) return Visit(node.children[child], state, way);
    leaves_.push_back(way);
    leaves_.back().is_repeat = true;
  }

  void Branch(NodeId id, std::size_t child, const KnowledgeState& state, Leaf way) {
    const PlanNode& node = tree_.node(id);
    std::optional<KnowledgeState> learned;
    if (node.kind == PlanNode::Kind::kWhether) {
      Say(node.formula, child == 0, state, way);
      learned = knowledge_.Learned(state, node.formula, child == 0);
    } else {
      way.literals.push_back({node.values[child], true});
      learned = knowledge_.Learned(state, way.literals.back());
    }
    way.branches.push_back({id, child, OutcomeText(task_, node, child)});
    if (learned) GoOn(node, child, *learned, way);
  }

  void Say(contingent::FormulaId formula, bool value, const KnowledgeState& state,
           Leaf& way) const {
    if (const auto& bound = task_.formulas[formula.index()].bound) {
      way.bounds.push_back(value ? *bound : Negation(*bound));
      return;
    }
    std::vector<GroundLiteral> literals = knowledge_.UndeterminedLiterals(formula, state);
    if (!value && literals.size() > 1) return way.denied.push_back(std::move(literals));
    for (GroundLiteral& literal : literals) {
      literal.is_positive = literal.is_positive == value;
      way.literals.push_back(literal);
    }
  }

  const contingent::GroundTask& task_;
  const contingent::PlanTree& tree_;
  const std::size_t most_;
  contingent::KnowledgeBase knowledge_;
  std::vector<Leaf> leaves_;
};

// Draws a world for one leaf. The conditions of the leaf narrow the kinds that each part may have,
// and the hidden properties are drawn from what is left.
class WorldSearch {
 public:
  WorldSearch(const Leaf& leaf, const Interpretation& interpretation,
              const domain::Problem& problem, RandomStream& random)
      : leaf_(leaf), interpretation_(interpretation), problem_(problem), random_(random) {
    for (std::size_t i = 0; i < problem.parts.size(); ++i) kinds_.push_back(KindsOf(PartId(i)));
    asked_.resize(kinds_.size());
  }

  std::variant<HiddenWorld, std::string> Find() {
    if (!ChooseWorld()) {
      return no_fault_.empty() ? "in no world of the scenario " + refuted_ : no_fault_;
    }
    for (const GroundLiteral& literal : leaf_.literals) {
      if (!interpretation_.IsObservable(literal.atom)) {
        return fmt::format("no sensor tells whether {}",
                           interpretation_.task.atoms[literal.atom.index()]);
      }
      Narrow(literal);
    }
    for (const contingent::Bound& bound : leaf_.bounds) Narrow(bound);
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i].masses.empty() || kinds_[i].colors.empty()) return Refutation(PartId(i));
    }
    DrawHidden();
    return std::move(world_);
  }

 private:
  // Chooses one of the scenario's worlds for the leaf. A world gets a fault only if the leaf
  // refutes the world without a fault.
  bool ChooseWorld() {
    const int worlds = interpretation_.WorldCount();
    const int first = worlds > 1 ? random_.Index(worlds) : 0;
    for (int tried = 0; tried < worlds; ++tried) {
      world_ = HiddenWorld{};
      world_.world = (first + tried) % worlds;
      if (!IsRefuted() || ChooseFault()) return true;
    }
    return false;
  }

  bool ChooseFault() {
    if (!interpretation_.planned) return false;
    for (const StepError& error : ErrorsOf(*interpretation_.planned, world_.world)) {
      world_.fault = Fault{.action = error.step, .error = error.error};
      if (IsRefuted()) continue;
      auto made = FaultFor(*interpretation_.planned, world_.world, error, random_);
      if (auto* fault = std::get_if<Fault>(&made)) {
        world_.fault = std::move(*fault);
        return true;
      }
      no_fault_ = std::get<std::string>(made);
    }
    world_.fault.reset();
    return false;
  }

  // Returns the kinds that a part may have. A mass that is not hidden is the mass of the model, and
  // a colour that is not hidden is none of the named colours.
  HiddenKinds KindsOf(PartId part) const {
    const auto hidden = interpretation_.hidden.find(part);
    HiddenKinds kinds = hidden == interpretation_.hidden.end() ? HiddenKinds{} : hidden->second;
    const double mass = problem_.part(part).model->mass().mass;
    if (kinds.masses.empty()) kinds.masses = {{mass, mass}};
    if (kinds.colors.empty()) kinds.colors = {sense::ColorId::None()};
    return kinds;
  }

  void Narrow(const GroundLiteral& literal) {
    const Predicate* const predicate = interpretation_.PredicateOf(literal.atom);
    if (predicate == nullptr) return;
    const PartId part = PartOf(interpretation_.task.ground_atoms[literal.atom.index()].arguments);
    if (part.IsNone()) return;
    const HiddenKinds before = kinds_[part.index()];
    predicate->Narrow(kinds_[part.index()], literal.is_positive);
    if (kinds_[part.index()] == before) return;
    asked_[part.index()].push_back(TextOf(interpretation_.task, literal));
  }

  void Narrow(const contingent::Bound& bound) {
    const Quantity* const quantity = interpretation_.QuantityOf(bound.function);
    if (quantity == nullptr) return;
    const PartId part = PartOf(interpretation_.task.functions[bound.function.index()].arguments);
    if (part.IsNone()) return;
    quantity->Narrow(kinds_[part.index()], WhereHolds(bound));
    asked_[part.index()].push_back(TextOf(interpretation_.task, contingent::Formula{{}, bound}));
  }

  std::string Refutation(PartId part) const {
    const bool is_hidden = interpretation_.hidden.contains(part);
    return fmt::format("the {} properties of {} exclude {}",
                       is_hidden ? "possible hidden" : "known", problem_.part(part).name,
                       fmt::join(asked_[part.index()], " & "));
  }

  PartId PartOf(const std::vector<std::string>& arguments) const {
    return RolesOf(problem_, arguments).part;
  }

  void DrawHidden() {
    for (const auto& [part, hidden] : interpretation_.hidden) {
      HiddenKinds kinds = kinds_[part.index()];
      if (hidden.masses.empty()) kinds.masses.clear();
      if (hidden.colors.empty()) kinds.colors.clear();
      DrawPart(part, kinds, random_, world_);
    }
  }

  bool IsRefuted() {
    for (const GroundLiteral& literal : leaf_.literals) {
      if (!IsRefuted(literal)) continue;
      refuted_ = TextOf(interpretation_.task, literal);
      return true;
    }
    return false;
  }

  bool IsRefuted(const GroundLiteral& literal) const {
    const Predicate* const predicate = interpretation_.PredicateOf(literal.atom);
    if (predicate == nullptr) return false;
    const auto& arguments = interpretation_.task.ground_atoms[literal.atom.index()].arguments;
    const auto is_true = predicate->IsTrueIn(world_, RolesOf(problem_, arguments));
    return is_true && *is_true != literal.is_positive;
  }

  const Leaf& leaf_;
  const Interpretation& interpretation_;
  const domain::Problem& problem_;
  RandomStream& random_;
  std::vector<HiddenKinds> kinds_;               // the kinds that each part may have
  std::vector<std::vector<std::string>> asked_;  // the conditions that narrowed each part's kinds
  HiddenWorld world_;
  std::string refuted_;   // the last refuted condition of the leaf
  std::string no_fault_;  // why there is no fault although one is needed
};

// Tries the ways in which a leaf's denied conjunctions can be false until one way has a world. Each
// conjunction is made false by one literal that a sensor can observe. If a literal of the leaf
// already makes a conjunction false, no such choice is needed for this conjunction.
class CaseSearch {
 public:
  CaseSearch(const Interpretation& interpretation, const domain::Problem& problem,
             RandomStream& random)
      : interpretation_(interpretation), problem_(problem), random_(random) {}

  std::variant<HiddenWorld, std::string> Find(const Leaf& leaf, std::size_t next = 0) {
    while (next < leaf.denied.size() && IsDenied(leaf.denied[next], leaf)) ++next;
    if (next == leaf.denied.size()) {
      return WorldSearch(leaf, interpretation_, problem_, random_).Find();
    }
    std::vector<GroundLiteral> observable = leaf.denied[next];
    std::erase_if(observable,
                  [&](const GroundLiteral& l) { return !interpretation_.IsObservable(l.atom); });
    if (observable.empty()) return Find(leaf, next + 1);
    std::ranges::rotate(observable,
                        observable.begin() + random_.Index(static_cast<int>(observable.size())));
    std::variant<HiddenWorld, std::string> found;
    for (const GroundLiteral& literal : observable) {
      Leaf longer = leaf;
      longer.literals.push_back({literal.atom, !literal.is_positive});
      found = Find(longer, next + 1);
      if (std::holds_alternative<HiddenWorld>(found)) break;
    }
    return found;
  }

 private:
  static bool IsDenied(const std::vector<GroundLiteral>& conjunction, const Leaf& leaf) {
    return std::ranges::any_of(conjunction, [&](const GroundLiteral& l) {
      const GroundLiteral negation{l.atom, !l.is_positive};
      return std::ranges::find(leaf.literals, negation) != leaf.literals.end();
    });
  }

  const Interpretation& interpretation_;
  const domain::Problem& problem_;
  RandomStream& random_;
};

}  // namespace

std::string Leaf::Text() const {
  if (branches.empty()) return "always";
  std::vector<std::string> texts;
  for (const TakenBranch& branch : branches) texts.push_back(branch.text);
  return fmt::format("{}{}", fmt::join(texts, ", "), is_repeat ? ", and again" : "");
}

bool Leaf::IsOn(const Walk& walk) const {
  const std::size_t count = branches.size();
  if (walk.branches.size() < count) return false;
  const auto choice = [](const TakenBranch& branch) {
    return std::pair(branch.node, branch.child);
  };
  const bool is_same =
      std::ranges::equal(branches, std::span(walk.branches).first(count), {}, choice, choice);
  if (is_repeat) return is_same;
  const bool is_end =
      walk.end == TrialOutcome::kSucceeded || walk.end == TrialOutcome::kOperatorCalled;
  return is_same && is_end && walk.branches.size() == count;
}

std::vector<Leaf> LeavesOf(const contingent::GroundTask& task, const contingent::PlanTree& tree,
                           std::size_t most) {
  return LeafSearch(task, tree, most).Find();
}

std::variant<HiddenWorld, std::string> FindWorld(const Leaf& leaf,
                                                 const Interpretation& interpretation,
                                                 const domain::Problem& problem,
                                                 RandomStream& random) {
  return CaseSearch(interpretation, problem, random).Find(leaf);
}

std::optional<HiddenWorld> WorldFor(const Leaf& leaf, const Interpretation& interpretation,
                                    const domain::Problem& problem, RandomStream& random) {
  auto found = FindWorld(leaf, interpretation, problem, random);
  if (auto* world = std::get_if<HiddenWorld>(&found)) return std::move(*world);
  return std::nullopt;
}

}  // namespace assay::execution
