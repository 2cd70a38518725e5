#include "sim/enact/leaves.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "planner/contingent/knowledge_base.h"
#include "planner/contingent/tree_text.h"

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
      if (after && !node.Repeats(0)) Visit(node.children.front(), *after, way);
    } else {
      for (std::size_t child = 0; child < node.children.size(); ++child) {
        if (!node.Repeats(child)) Branch(id, child, state, way);
      }
    }
  }

  void Branch(NodeId id, std::size_t child, const KnowledgeState& state, Leaf way) {
    const PlanNode& node = tree_.node(id);
    GroundLiteral literal;
    KnowledgeState learned;
    if (node.kind == PlanNode::Kind::kWhether) {
      literal = knowledge_.UndeterminedLiteral(node.formula, state);
      if (child == 1) literal.is_positive = !literal.is_positive;
      learned = knowledge_.Learned(state, node.formula, child == 0);
    } else {
      literal = {node.values[child], true};
      learned = knowledge_.Learned(state, literal);
    }
    way.branches.push_back({id, child, OutcomeText(task_, node, child)});
    way.literals.push_back(literal);
    Visit(node.children[child], learned, way);
  }

  const contingent::GroundTask& task_;
  const contingent::PlanTree& tree_;
  const std::size_t most_;
  contingent::KnowledgeBase knowledge_;
  std::vector<Leaf> leaves_;
};

}  // namespace

std::string Leaf::Text() const {
  if (branches.empty()) return "always";
  std::vector<std::string> texts;
  for (const TakenBranch& branch : branches) texts.push_back(branch.text);
  return fmt::format("{}", fmt::join(texts, ", "));
}

bool Leaf::IsEndOf(const Walk& walk) const {
  return walk.end == WalkEnd::kGoal &&
         std::ranges::equal(branches, walk.branches, [](const auto& a, const auto& b) {
           return a.node == b.node && a.child == b.child;
         });
}

std::vector<Leaf> LeavesOf(const contingent::GroundTask& task, const contingent::PlanTree& tree,
                           std::size_t most) {
  return LeafSearch(task, tree, most).Find();
}

// What a leaf asks of different parts is independent, so that each is drawn by itself.
std::optional<HiddenWorld> WorldFor(const Leaf& leaf, const Interpretation& interpretation,
                                    const domain::Problem& problem, RandomStream& random) {
  HiddenWorld world;
  const auto is_refuted = [&](const GroundLiteral& literal) {
    const Meaning* const meaning = interpretation.MeaningOf(literal.atom);
    if (meaning == nullptr) return false;
    const auto& arguments = interpretation.task.ground_atoms[literal.atom.index()].arguments;
    const auto is_true = meaning->IsTrueIn(world, RolesOf(problem, arguments));
    return is_true && *is_true != literal.is_positive;
  };
  const int worlds = interpretation.WorldCount();
  const int first = worlds > 1 ? random.Index(worlds) : 0;
  for (int tried = 0;; ++tried) {
    if (tried == worlds) return std::nullopt;
    world.world = (first + tried) % worlds;
    if (std::ranges::none_of(leaf.literals, is_refuted)) break;
  }
  for (const auto& [part, kinds] : interpretation.hidden) {
    int draws = 0;
    do {
      if (draws++ == kMostDraws) return std::nullopt;
      DrawPart(part, kinds, random, world);
    } while (std::ranges::any_of(leaf.literals, is_refuted));
  }
  return world;
}

}  // namespace assay::enact
