#include "planner/finemotion/strategy_search/sequence_search.h"

#include <algorithm>
#include <cmath>

#include "planner/finemotion/forces/force_signature.h"
#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

namespace {

constexpr double kFarthest = 0.015;   // metres that a move to a contact may take
constexpr double kWidestTurn = 0.15;  // radians that a turn to a contact may take
constexpr double kThin = 1.5e-4;      // metres; smaller errors count as none
constexpr std::size_t kMostMotions = 24;
// The guidance is not a lower bound of the cost, so sequences need not be the cheapest. What
// matters is that they absorb errors, and the cost only hints at that when errors are small.
constexpr double kPerCriticalPoint = 10;
constexpr double kPerWideDirection = 4;
constexpr double kPerError = 3;
// Diverse searches weigh the errors with these two numbers in place of the two above.
constexpr double kPerHalving = 2;
constexpr double kPerErrorBeside = 1.5;
constexpr double kPerRadian = 20;
constexpr double kPerMetre = 1000;

}  // namespace

struct SequenceSearch::Node {
  BelievedPose believed;
  NodePointer parent = {};
  Maneuver maneuver = {};
  Start start = {};
  int point = 0;  // index of the critical point where the node is
  std::size_t motions = 0;
  double cost = 0;  // a lower bound, or the whole cost once it is `exact`
  bool exact = true;
  double guidance = 0;
  int number = 0;  // number of the node in the order in which nodes are made
};

// Orders nodes by the estimated cost of the whole sequence. If the costs are equal, the node with
// more motions is first.
bool SequenceSearch::IsLater::operator()(const NodePointer& a, const NodePointer& b) const {
  const double cost_a = a->cost + a->guidance;
  const double cost_b = b->cost + b->guidance;
  if (cost_a != cost_b) return cost_a > cost_b;
  return a->motions != b->motions ? a->motions < b->motions : a->number > b->number;
}

SequenceSearch::SequenceSearch(const SequenceProblem& problem, Starts& starts, Effort effort)
    : problem_(problem), effort_(effort), known_(problem.passage.mating) {
  for (int i = 0; i < problem.options.starts; ++i)
    Open(i == 0 ? starts.Upright() : starts.Random(), starts);
}

std::optional<Sequence> SequenceSearch::Next() {
  while (!open_.empty() && expanded_ < Budget()) {
    const NodePointer node = open_.top();
    open_.pop();
    if (!node->exact) {
      open_.push(WithExactCost(*node));
      continue;
    }
    if (IsGoal(*node)) return SequenceTo(node);
    ++expanded_;
    if (node->motions < kMostMotions) Expand(node);
  }
  return std::nullopt;
}

const Maneuvering& SequenceSearch::ManeuveringAt(int point) const {
  return problem_.maneuvering[static_cast<std::size_t>(point)];
}

bool SequenceSearch::IsGoal(const Node& node) const {
  return node.motions > 0 && IsLast(node.point) &&
         ManeuveringAt(node.point).IsThrough(node.believed);
}

int SequenceSearch::Budget() const {
  const StrategyOptions& options = problem_.options;
  const int nodes = effort_ == Effort::kThorough ? options.thorough_nodes : options.nodes;
  return nodes * problem_.passage.critical_points();
}

void SequenceSearch::Open(const Start& start, const Starts& starts) {
  Node node;
  node.start = start;
  node.believed = starts.BelievedPoseAt(start, problem_.multiple);
  if (ManeuveringAt(0).IsReached(node.believed)) Push(std::move(node));
}

void SequenceSearch::Expand(const NodePointer& node) {
  const Situation situation = ManeuveringAt(node->point).At(node->believed);
  for (const Maneuver& maneuver : ManeuversFrom(*node)) {
    const Maneuvered done = Apply(node->point, situation, maneuver, Margins::kNone);
    if (!done.certain) {
      Refuse(*node, done);
      continue;
    }
    const auto motions = static_cast<double>(done.motions.size());
    Push({.believed = done.after,
          .parent = node,
          .maneuver = maneuver,
          .start = node->start,
          .point = PointAfter(maneuver, node->point),
          .motions = node->motions + done.motions.size(),
          .cost = node->cost + problem_.options.transitions * motions,
          .exact = effort_ == Effort::kThorough});
  }
}

void SequenceSearch::Refuse(const Node& node, const Maneuvered& done) {
  if (done.motions.empty() || done.motions.back().check.unwanted.empty()) return;
  if (refused_ && node.guidance >= refused_guidance_) return;
  refused_ = done.motions.back().check.unwanted.front();
  refused_guidance_ = node.guidance;
}

// Computes the node's exact cost. This is done only for nodes that come first in the queue, because
// margins take long to compute and most nodes never come first.
SequenceSearch::NodePointer SequenceSearch::WithExactCost(Node node) {
  const StrategyOptions& options = problem_.options;
  const int point = node.parent->point;
  const Situation before = ManeuveringAt(point).At(node.parent->believed);
  const Maneuvered done = Apply(point, before, node.maneuver, Margins::kLeast);
  node.cost += options.deviation / done.LeastScale() + options.confusion * ConfusionOf(done);
  node.exact = true;
  return std::make_shared<const Node>(std::move(node));
}

Maneuvered SequenceSearch::Apply(int point, const Situation& situation, const Maneuver& maneuver,
                                 Margins margins) {
  Maneuvered done = ManeuveringAt(point).Apply(situation, maneuver, margins);
  comparison_ += done.Comparison();
  return done;
}

void SequenceSearch::Push(Node node) {
  if (effort_ != Effort::kGuided && !known_.Add(node.point, node.believed)) return;
  node.number = made_++;
  node.guidance = GuidanceOf(node);
  open_.push(std::make_shared<const Node>(std::move(node)));
}

std::vector<Maneuver> SequenceSearch::ManeuversFrom(const Node& node) const {
  using Kind = Maneuver::Kind;
  const Vector3& in = problem_.passage.mating;
  std::vector<Maneuver> maneuvers;
  if (!IsLast(node.point) && ManeuveringAt(node.point).IsThrough(node.believed))
    maneuvers.push_back({Kind::kAdvance});
  for (const double length : {1e-3, 3e-3}) maneuvers.push_back({Kind::kMove, -in, length});
  maneuvers.push_back({Kind::kMove, in, kFarthest, true});
  const bool is_diverse = effort_ == Effort::kDiverse;
  if (is_diverse) maneuvers.push_back({Kind::kMove, in, 1e-3});
  for (const Vector3& lateral : ManeuveringAt(node.point).laterals()) {
    if (is_diverse)
      maneuvers.push_back({Kind::kMove, (lateral + in).normalized(), kFarthest, true});
    maneuvers.push_back({Kind::kMove, lateral, kFarthest, true});
    maneuvers.push_back({Kind::kTurn, lateral, kWidestTurn, true});
  }
  for (const double sign : {1.0, -1.0}) {
    maneuvers.push_back({Kind::kTurn, sign * in, kWidestTurn, true});
  }
  for (const ContactKey& contact : node.believed.kept) {
    maneuvers.push_back({Kind::kLetGo, {}, 1e-3, false, contact});
  }
  maneuvers.push_back({Kind::kCenter});
  maneuvers.push_back({Kind::kUpright});
  return maneuvers;
}

// Compares the forces of the last planned contact with the forces of the contact that is most
// likely made instead. Returns how alike they are.
double SequenceSearch::ConfusionOf(const Maneuvered& done) const {
  const CertainMotion& last = done.motions.back();
  if (last.check.unwanted.empty() || !last.command.until) return 0;
  const auto signature = [&](const ContactKey& key) {
    std::vector<PrimitiveContact> touching;
    for (const ContactKey& kept : last.command.kept) {
      if (const auto* contact = Find(last.contacts, kept)) touching.push_back(*contact);
    }
    if (const auto* contact = Find(last.contacts, key)) touching.push_back(*contact);
    return SignatureOf(touching, problem_.options.friction);
  };
  const double separation =
      Separation(signature(*last.command.until), signature(last.check.unwanted.front().contact),
                 problem_.options.radius);
  return 1 - separation;
}

// Returns the distance of the tip from the way in, in metres.
double SequenceSearch::Beside(const Node& node) const {
  const Passage& passage = problem_.passage;
  const Vector3 to =
      node.believed.X_StationaryMoving.translation() - passage.X_StationaryEntry.translation();
  return (to - to.dot(passage.mating) * passage.mating).norm();
}

// Returns the part of the guidance that is due to the errors.
double SequenceSearch::ErrorsToReduce(const BelievedPose& believed, const Maneuvering& here) const {
  PoseChanges errors = believed.errors;
  errors.bottomRows<3>() *= problem_.options.radius;
  using Spread = Eigen::Matrix<double, kPoseDimensions, kPoseDimensions>;
  const Spread spread = errors * errors.transpose();
  const auto thick = std::ranges::count_if(numeric::EigenvaluesOfSymmetric(spread),
                                           [](double e) { return e > kThin * kThin; });
  if (effort_ == Effort::kDiverse)
    return kPerHalving * here.Halvings(believed) + kPerErrorBeside * static_cast<double>(thick);
  return kPerWideDirection * here.WideDirections(believed) + kPerError * static_cast<double>(thick);
}

double SequenceSearch::GuidanceOf(const Node& node) const {
  const Maneuvering& here = ManeuveringAt(node.point);
  const double turn = here.ToUpright(node.believed.X_StationaryMoving).norm();
  return kPerCriticalPoint * (problem_.passage.critical_points() - node.point) +
         ErrorsToReduce(node.believed, here) + std::min(2.0, kPerRadian * turn) +
         std::min(1.0, kPerMetre * Beside(node));
}

Sequence SequenceSearch::SequenceTo(const NodePointer& goal) {
  Sequence sequence{goal->start, {}};
  for (const Node* node = goal.get(); node->parent; node = node->parent.get())
    sequence.maneuvers.insert(sequence.maneuvers.begin(), node->maneuver);
  return sequence;
}

}  // namespace assay::finemotion
