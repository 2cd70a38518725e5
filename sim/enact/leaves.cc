#include "sim/enact/leaves.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>

#include "planner/contingent/knowledge_base.h"
#include "planner/contingent/tree_text.h"
#include "sim/enact/mishap.h"

namespace assay::enact {

using contingent::GroundLiteral;
using contingent::KnowledgeState;
using contingent::NodeId;
using contingent::PlanNode;

namespace {

constexpr int kMostDraws = 1000;  // of what is hidden in one part

// Goes through the tree with what is known on the way.
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
    KnowledgeState learned;
    if (node.kind == PlanNode::Kind::kWhether) {
      Say(node.formula, child == 0, state, way);
      learned = knowledge_.Learned(state, node.formula, child == 0);
    } else {
      way.literals.push_back({node.values[child], true});
      learned = knowledge_.Learned(state, way.literals.back());
    }
    way.branches.push_back({id, child, OutcomeText(task_, node, child)});
    GoOn(node, child, learned, way);
  }

  void Say(contingent::FormulaId formula, bool value, const KnowledgeState& state,
           Leaf& way) const {
    if (const auto& bound = task_.formulas[formula.index()].bound) {
      way.bounds.push_back(value ? *bound : Negation(*bound));
      return;
    }
    GroundLiteral literal = knowledge_.UndeterminedLiteral(formula, state);
    literal.is_positive = literal.is_positive == value;
    way.literals.push_back(literal);
  }

  const contingent::GroundTask& task_;
  const contingent::PlanTree& tree_;
  const std::size_t most_;
  contingent::KnowledgeBase knowledge_;
  std::vector<Leaf> leaves_;
};

// What a leaf asks of different parts is independent, so that each is drawn by itself.
class WorldSearch {
 public:
  WorldSearch(const Leaf& leaf, const Interpretation& interpretation,
              const domain::Problem& problem, RandomStream& random)
      : leaf_(leaf), interpretation_(interpretation), problem_(problem), random_(random) {}

  std::variant<HiddenWorld, std::string> Find() {
    if (!ChooseWorld()) {
      return no_mishap_.empty() ? "in no world of the scenario " + refuted_ : no_mishap_;
    }
    for (const auto& [part, kinds] : interpretation_.hidden) {
      if (!Draw(part, kinds)) {
        return fmt::format("nothing that {} may hide makes {}", problem_.part(part).name, refuted_);
      }
    }
    return std::move(world_);
  }

 private:
  // Worlds in which nothing goes wrong come first.
  bool ChooseWorld() {
    const int worlds = interpretation_.WorldCount();
    const int first = worlds > 1 ? random_.Index(worlds) : 0;
    for (int tried = 0; tried < worlds; ++tried) {
      world_ = HiddenWorld{};
      world_.world = (first + tried) % worlds;
      if (!IsRefuted() || ChooseMishap()) return true;
    }
    return false;
  }

  bool ChooseMishap() {
    if (!interpretation_.planned) return false;
    for (const StepError& error : ErrorsOf(*interpretation_.planned, world_.world)) {
      world_.mishap = Mishap{.action = error.step, .error = error.error};
      if (IsRefuted()) continue;
      auto made = MishapFor(*interpretation_.planned, world_.world, error, random_);
      if (auto* mishap = std::get_if<Mishap>(&made)) {
        world_.mishap = std::move(*mishap);
        return true;
      }
      no_mishap_ = std::get<std::string>(made);
    }
    world_.mishap.reset();
    return false;
  }

  bool Draw(PartId part, const HiddenKinds& kinds) {
    for (int draws = 0; draws < kMostDraws; ++draws) {
      DrawPart(part, kinds, random_, world_);
      if (!IsRefuted()) return true;
    }
    return false;
  }

  bool IsRefuted() {
    const contingent::GroundTask& task = interpretation_.task;
    for (const GroundLiteral& literal : leaf_.literals) {
      if (!IsRefuted(literal)) continue;
      refuted_ = TextOf(task, literal);
      return true;
    }
    for (const contingent::Bound& bound : leaf_.bounds) {
      if (!IsRefuted(bound)) continue;
      refuted_ = TextOf(task, contingent::Formula{{}, bound});
      return true;
    }
    return false;
  }

  bool IsRefuted(const contingent::Bound& bound) const {
    const Quantity* const quantity = interpretation_.QuantityOf(bound.function);
    if (quantity == nullptr) return false;
    const auto& arguments = interpretation_.task.functions[bound.function.index()].arguments;
    const auto value = quantity->ValueIn(world_, RolesOf(problem_, arguments));
    return value && !Holds(bound, *value);
  }

  bool IsRefuted(const GroundLiteral& literal) const {
    const Meaning* const meaning = interpretation_.MeaningOf(literal.atom);
    if (meaning == nullptr) return false;
    const auto& arguments = interpretation_.task.ground_atoms[literal.atom.index()].arguments;
    const auto is_true = meaning->IsTrueIn(world_, RolesOf(problem_, arguments));
    return is_true && *is_true != literal.is_positive;
  }

  const Leaf& leaf_;
  const Interpretation& interpretation_;
  const domain::Problem& problem_;
  RandomStream& random_;
  HiddenWorld world_;
  std::string refuted_;    // of what the leaf asks, the last
  std::string no_mishap_;  // why one that is needed cannot be
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
  const bool is_end = walk.end == WalkEnd::kGoal || walk.end == WalkEnd::kOperator;
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
  return WorldSearch(leaf, interpretation, problem, random).Find();
}

std::optional<HiddenWorld> WorldFor(const Leaf& leaf, const Interpretation& interpretation,
                                    const domain::Problem& problem, RandomStream& random) {
  auto found = FindWorld(leaf, interpretation, problem, random);
  if (auto* world = std::get_if<HiddenWorld>(&found)) return std::move(*world);
  return std::nullopt;
}

}  // namespace assay::enact
