#include "planner/finemotion/strategy_search.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>

#include "planner/base/random.h"
#include "planner/finemotion/exact_replay.h"
#include "planner/finemotion/force_signature.h"
#include "planner/finemotion/friction_limit.h"

namespace assay::finemotion {

namespace {

constexpr double kAbove = 0.002;       // metres, of starts over all that errors can bring near
constexpr double kFarthest = 0.015;    // metres that a move may take to a contact
constexpr double kWidestTurn = 0.15;   // radians that a turn may take to one
constexpr double kLeastTilt = 0.035;   // radians, of starts: their edges are not parallel
constexpr double kLeastInside = 1e-3;  // metres, that their lowest corner is inside the entry
constexpr double kThin = 1.5e-4;       // metres: errors that are less are none
constexpr std::size_t kMostMotions = 24;
// The guidance is not a lower bound of the cost, so that sequences need not be the cheapest: what
// counts is that they absorb errors, which the cost of small ones only hints at.
constexpr double kPerCriticalPoint = 10;
constexpr double kPerWideDirection = 4;
constexpr double kPerError = 3;
constexpr double kPerRadian = 20;
constexpr double kPerMetre = 1000;
// What is certain for larger errors is for smaller ones; and sequences are not always found for
// the smaller ones, as parts that are less tilted come nearer to having parallel edges.
constexpr double kEnlarged[] = {1, 2};
// Of the errors, that sequences are searched for, round by round.
constexpr double kMultiples[] = {0.8, 0.7, 1, 0.5, 0.3, 0.15};
constexpr double kGrowth = 1.06;  // of the errors that a moved start must absorb
constexpr double kLeast = 0.1;    // multiple of the errors that a plan is of any use for

// Where a trial starts: turned and beside the entry.
struct Start {
  Vector3 turn = Vector3::Zero();    // rotation vector
  Vector3 beside = Vector3::Zero();  // across the way in
};

struct Node {
  Belief belief;
  std::shared_ptr<const Node> parent = {};
  Maneuver maneuver = {};
  Start start = {};
  int point = 0;  // of the passage's critical points, the one that it is at
  std::size_t motions = 0;
  double cost = 0;  // at least; all of it, once it is `exact`
  bool exact = true;
  double guidance = 0;
  int number = 0;  // in the order of their making
};
using NodePointer = std::shared_ptr<const Node>;

// By what the whole may cost; of equals, the ones that came farther.
struct IsLater {
  bool operator()(const NodePointer& a, const NodePointer& b) const {
    const double cost_a = a->cost + a->guidance;
    const double cost_b = b->cost + b->guidance;
    if (cost_a != cost_b) return cost_a > cost_b;
    return a->motions != b->motions ? a->motions < b->motions : a->number > b->number;
  }
};

struct Replay {
  bool certain = false;
  std::vector<CertainMotion> motions;
};

class Search {
 public:
  // `multiple`: of the errors, that the sequence is searched for. `asked`: of them, for which its
  // margins are told.
  Search(const Passage& passage, const FineMotionErrors& errors, const StrategyOptions& options,
         int round, double multiple, double asked)
      : passage_(passage),
        errors_(errors),
        options_(options),
        multiple_(multiple),
        asked_(asked),
        random_(options.seed, fmt::format("starts of strategies {}", round)) {
    const MotionChecker checker = CheckerFor(passage, errors, options);
    for (int point = 0; point < passage.critical_points(); ++point)
      maneuvering_.push_back(Maneuvering(passage, point, checker, options.reach));
  }

  FineMotionPlan Run() {
    if (const NodePointer goal = Find()) {
      plan_.obstacle.reset();
      Start start = goal->start;
      for (const Node* node = goal.get(); node->parent; node = node->parent.get()) {
        plan_.maneuvers.insert(plan_.maneuvers.begin(), node->maneuver);
      }
      plan_.absorbed = multiple_;
      Widen(start);
      Finish(start);
    }
    return std::move(plan_);
  }

 private:
  // Maneuvers at the critical point that a node is at.
  const Maneuvering& ManeuveringAt(int point) const {
    return maneuvering_[static_cast<std::size_t>(point)];
  }
  bool IsLast(int point) const { return point == passage_.critical_points() - 1; }

  // --- Starts.

  // Tilted any way, and shifted so that the corner that is then the lowest is inside the entry.
  Start RandomStart() {
    const Vector3& in = passage_.mating;
    const Vector3 side = in.unitOrthogonal();
    const Vector3 other = in.cross(side);
    Start start;
    start.turn = random_.Uniform(-options_.twist, options_.twist) * in;
    for (const Vector3& axis : {side, other}) {
      const double tilt = random_.Uniform(-1, 1);
      const double most = std::max(kLeastTilt, options_.tilt);
      start.turn += std::copysign(std::lerp(kLeastTilt, most, std::abs(tilt)), tilt) * axis;
    }
    const Vector3 corner = LowestCorner(start.turn);
    for (const Vector3& axis : {side, other}) {
      const double inside = random_.Uniform(kLeastInside, options_.offset);
      start.beside -= std::copysign(inside, corner.dot(axis)) * axis;
    }
    return start;
  }

  // For errors that are less than the play.
  Start UprightStart() const {
    return {.turn = Vector3::Zero(), .beside = kLeastInside * passage_.mating.unitOrthogonal()};
  }

  Vector3 LowestCorner(const Vector3& turn) const {
    PoseChange z;
    z << Vector3::Zero(), turn;
    const Pose X = Displaced(passage_.X_StationaryEntry, z);
    Vector3 lowest = Vector3::Zero();
    for (const OuterVertex& vertex : passage_.moving.vertices) {
      const Vector3 at = X.linear() * vertex.p;
      if (at.dot(passage_.mating) > lowest.dot(passage_.mating)) lowest = at;
    }
    return lowest;
  }

  Start Near(const Start& start, double size) {
    const auto within = [&](double most) { return random_.Uniform(-most, most) * size; };
    const Vector3& in = passage_.mating;
    const Vector3 side = in.unitOrthogonal();
    const Vector3 other = in.cross(side);
    Start near = start;
    near.turn +=
        within(options_.twist) * in + within(options_.tilt) * side + within(options_.tilt) * other;
    near.beside += within(options_.offset) * side + within(options_.offset) * other;
    return near;
  }

  // So far up that the part is free, whatever the errors.
  Belief BeliefAt(const Start& start, double multiple) const {
    PoseChange z;
    z << start.beside, start.turn;
    Belief belief = BeliefIn(Displaced(passage_.X_StationaryEntry, z), errors_, multiple);
    double deepest = 0;
    const double wrong = errors_.tolerances.sum();  // of the parts, at most
    for (const OuterVertex& vertex : passage_.moving.vertices) {
      const Vector3 at = belief.X_StationaryMoving * vertex.p;
      const double reach =
          errors_.pose.head<3>().norm() +
          errors_.pose.tail<3>().norm() * std::min(vertex.p.norm(), options_.reach);
      const double depth = (at - passage_.X_StationaryEntry.translation()).dot(passage_.mating);
      deepest = std::max(deepest, depth + reach + wrong);
    }
    belief.X_StationaryMoving.translation() -= (deepest + kAbove) * passage_.mating;
    return belief;
  }

  // --- The search for a sequence.

  NodePointer Find() {
    std::priority_queue<NodePointer, std::vector<NodePointer>, IsLater> open;
    for (int i = 0; i < options_.starts; ++i) {
      Node node;
      node.start = i == 0 ? UprightStart() : RandomStart();
      node.belief = BeliefAt(node.start, multiple_);
      if (ManeuveringAt(0).IsReached(node.belief)) Push(std::move(node), open);
    }
    while (!open.empty() && plan_.expanded < options_.nodes * passage_.critical_points()) {
      const NodePointer node = open.top();
      open.pop();
      if (!node->exact) {
        open.push(WithExactCost(*node));
        continue;
      }
      if (IsLast(node->point) && ManeuveringAt(node->point).IsThrough(node->belief)) return node;
      ++plan_.expanded;
      if (node->motions < kMostMotions) Expand(node, open);
    }
    return nullptr;
  }

  template <class Queue>
  void Expand(const NodePointer& node, Queue& open) {
    const Situation situation = ManeuveringAt(node->point).At(node->belief);
    for (const Maneuver& maneuver : ManeuversFrom(*node)) {
      const Maneuvered done = Apply(node->point, situation, maneuver, Margins::kNone);
      if (!done.certain) {
        Refuse(*node, done);
        continue;
      }
      const auto motions = static_cast<double>(done.motions.size());
      Push({.belief = done.after,
            .parent = node,
            .maneuver = maneuver,
            .start = node->start,
            .point = PointAfter(maneuver, node->point),
            .motions = node->motions + done.motions.size(),
            .cost = node->cost + options_.transitions * motions,
            .exact = false},
           open);
    }
  }

  // Of the refused maneuvers, that from the node nearest to the goal tells what is in the way.
  void Refuse(const Node& node, const Maneuvered& done) {
    if (done.motions.empty() || done.motions.back().check.unwanted.empty()) return;
    if (plan_.obstacle && node.guidance >= refused_guidance_) return;
    plan_.obstacle = done.motions.back().check.unwanted.front();
    plan_.obstacle->scale *= multiple_;
    refused_guidance_ = node.guidance;
  }

  // Margins take long, and most nodes are never first.
  NodePointer WithExactCost(Node node) {
    const int point = node.parent->point;
    const Situation before = ManeuveringAt(point).At(node.parent->belief);
    const Maneuvered done = Apply(point, before, node.maneuver, Margins::kLeast);
    node.cost += options_.deviation / done.LeastScale() + options_.confusion * ConfusionOf(done);
    node.exact = true;
    return std::make_shared<const Node>(std::move(node));
  }

  Maneuvered Apply(int point, const Situation& situation, const Maneuver& maneuver,
                   Margins margins) {
    Maneuvered done = ManeuveringAt(point).Apply(situation, maneuver, margins);
    for (const CertainMotion& motion : done.motions) plan_.comparison += motion.check.comparison;
    return done;
  }

  template <class Queue>
  void Push(Node node, Queue& open) {
    node.number = made_++;
    node.guidance = GuidanceOf(node);
    open.push(std::make_shared<const Node>(std::move(node)));
  }

  static int PointAfter(const Maneuver& maneuver, int point) {
    return maneuver.kind == Maneuver::Kind::kAdvance ? point + 1 : point;
  }

  std::vector<Maneuver> ManeuversFrom(const Node& node) const {
    using Kind = Maneuver::Kind;
    const Vector3& in = passage_.mating;
    std::vector<Maneuver> maneuvers;
    if (!IsLast(node.point) && ManeuveringAt(node.point).IsThrough(node.belief))
      maneuvers.push_back({Kind::kAdvance});
    for (const double length : {1e-3, 3e-3}) maneuvers.push_back({Kind::kMove, -in, length});
    maneuvers.push_back({Kind::kMove, in, kFarthest, true});
    for (const Vector3& lateral : ManeuveringAt(node.point).laterals()) {
      maneuvers.push_back({Kind::kMove, lateral, kFarthest, true});
      maneuvers.push_back({Kind::kTurn, lateral, kWidestTurn, true});
    }
    for (const double sign : {1.0, -1.0}) {
      maneuvers.push_back({Kind::kTurn, sign * in, kWidestTurn, true});
    }
    for (const ContactKey& contact : node.belief.kept) {
      maneuvers.push_back({Kind::kLetGo, {}, 1e-3, false, contact});
    }
    maneuvers.push_back({Kind::kCenter});
    maneuvers.push_back({Kind::kUpright});
    return maneuvers;
  }

  // How alike the forces of the last planned contact and of what is likeliest instead are.
  double ConfusionOf(const Maneuvered& done) const {
    const CertainMotion& last = done.motions.back();
    if (last.check.unwanted.empty() || !last.command.until) return 0;
    const auto signature = [&](const ContactKey& key) {
      std::vector<PrimitiveContact> touching;
      for (const ContactKey& kept : last.command.kept) {
        if (const auto* contact = finemotion::Find(last.contacts, kept))
          touching.push_back(*contact);
      }
      if (const auto* contact = finemotion::Find(last.contacts, key)) touching.push_back(*contact);
      return SignatureOf(touching, options_.friction);
    };
    const double separation =
        Separation(signature(*last.command.until), signature(last.check.unwanted.front().contact),
                   options_.radius);
    return 1 - separation;
  }

  // How far the tip is from the way in, metres.
  double Beside(const Node& node) const {
    const Vector3 to =
        node.belief.X_StationaryMoving.translation() - passage_.X_StationaryEntry.translation();
    return (to - to.dot(passage_.mating) * passage_.mating).norm();
  }

  double GuidanceOf(const Node& node) const {
    PoseChanges errors = node.belief.errors;
    errors.bottomRows<3>() *= options_.radius;
    using Spread = Eigen::Matrix<double, kPoseDimensions, kPoseDimensions>;
    const Spread spread = errors * errors.transpose();
    const Eigen::SelfAdjointEigenSolver<Spread> axes(spread, Eigen::EigenvaluesOnly);
    const auto thick = (axes.eigenvalues().array() > kThin * kThin).count();
    const Maneuvering& here = ManeuveringAt(node.point);
    const double turn = here.ToUpright(node.belief.X_StationaryMoving).norm();
    return kPerCriticalPoint * (passage_.critical_points() - node.point) +
           kPerWideDirection * here.WideDirections(node.belief) +
           kPerError * static_cast<double>(thick) + std::min(2.0, kPerRadian * turn) +
           std::min(1.0, kPerMetre * Beside(node));
  }

  // --- The sequence from other starts, with larger errors.

  Replay From(const Start& start, double multiple, Margins margins) {
    ++plan_.replayed;
    Replay replay;
    Belief belief = BeliefAt(start, multiple);
    if (!ManeuveringAt(0).IsReached(belief)) return replay;
    int point = 0;
    for (const Maneuver& maneuver : plan_.maneuvers) {
      const int after = PointAfter(maneuver, point);
      if (after != point && !ManeuveringAt(point).IsThrough(belief)) return replay;
      Maneuvered done = Apply(point, ManeuveringAt(point).At(belief), maneuver, margins);
      for (CertainMotion& motion : done.motions) motion.critical_point = point;
      std::ranges::move(done.motions, std::back_inserter(replay.motions));
      if (!done.certain) return replay;
      belief = std::move(done.after);
      point = after;
    }
    replay.certain = ManeuveringAt(point).IsThrough(belief);
    return replay;
  }

  // Moves the start at random, less and less, and keeps it where it absorbs more.
  void Widen(Start& start) {
    double size = 0.3;
    for (int i = 0; i < options_.tries && plan_.absorbed < options_.greatest; ++i) {
      const Start moved = i == 0 ? start : Near(start, size);
      if (From(moved, kGrowth * plan_.absorbed, Margins::kNone).certain) {
        start = moved;
        plan_.absorbed *= kGrowth;
        size = std::min(0.3, 1.5 * size);
      } else {
        size = std::max(0.02, 0.97 * size);
      }
    }
  }

  // All motions, with as many of the errors as they are certain for.
  void Finish(const Start& start) {
    plan_.found = plan_.absorbed >= 1;
    plan_.X_StationaryStart = BeliefAt(start, 1).X_StationaryMoving;
    if (!plan_.found) {
      const Replay replay = From(start, 1, Margins::kAll);
      if (!replay.certain && !replay.motions.empty()) {
        const std::vector<Unwanted>& unwanted = replay.motions.back().check.unwanted;
        if (!unwanted.empty()) plan_.obstacle = unwanted.front();
      }
    }
    plan_.motions = From(start, std::min(asked_, plan_.absorbed), Margins::kAll).motions;
    LengthenForAllThatIsAbsorbed(start);
    // Above the greatest that is looked for, what was asked for is what is known.
    plan_.friction_limit = std::max(kGreatestFriction, options_.friction);
    for (const CertainMotion& motion : plan_.motions) {
      const double limit = FrictionLimitOf(motion);
      if (limit < kGreatestFriction) plan_.friction_limit = std::min(plan_.friction_limit, limit);
    }
  }

  // Contacts come the later, the greater the errors are.
  void LengthenForAllThatIsAbsorbed(const Start& start) {
    const Replay most = From(start, plan_.absorbed, Margins::kNone);
    for (std::size_t i = 0; i < std::min(most.motions.size(), plan_.motions.size()); ++i) {
      double& longest = plan_.motions[i].check.longest;
      longest = std::max(longest, most.motions[i].check.longest);
    }
  }

  const Passage& passage_;
  const FineMotionErrors& errors_;
  const StrategyOptions& options_;
  double multiple_;
  double asked_;
  std::vector<Maneuvering> maneuvering_;  // at each critical point
  RandomStream random_;
  FineMotionPlan plan_;
  double refused_guidance_ = 0;  // of the node that the obstacle is of
  int made_ = 0;
};

// What it tells in multiples of larger errors, in multiples of the errors.
void TellInSmaller(FineMotionPlan& plan, double enlarged) {
  plan.absorbed *= enlarged;
  if (plan.obstacle) plan.obstacle->scale *= enlarged;
}

// With so many times the errors, all motions go as planned in exact geometry. How many replays that
// was found in; none: one went otherwise.
std::optional<int> Confirmed(const FineMotionPlan& plan, double multiple, const Passage& passage,
                             const FineMotionErrors& errors, const StrategyOptions& options) {
  const ExactReplay replay{.passage = passage,
                           .X_StationaryStart = plan.X_StationaryStart,
                           .motions = plan.motions,
                           .radius = options.radius,
                           .velocity_error = errors.velocity};
  const ExactReplays replays =
      ReplayWithErrors(replay, multiple * errors.pose, options.drawn, options.seed);
  return replays.deviation ? std::nullopt : std::optional(replays.tried);
}

// Rows are linear; what they leave out grows with the square of the errors.
void AbsorbWhatIsConfirmed(FineMotionPlan& plan, const Passage& passage,
                           const FineMotionErrors& errors, const StrategyOptions& options) {
  while (plan.absorbed >= kLeast) {
    if (const auto replays = Confirmed(plan, plan.absorbed, passage, errors, options)) {
      plan.exact_replays = *replays;
      return;
    }
    const double less = plan.absorbed / kGrowth;
    plan.absorbed = plan.absorbed > 1 ? std::max(1.0, less) : less;
  }
}

}  // namespace

FineMotionErrors Enlarged(const FineMotionErrors& errors, double multiple) {
  return {multiple * errors.pose, errors.velocity, multiple * errors.tolerances};
}

MotionChecker CheckerFor(const Passage& passage, const FineMotionErrors& errors,
                         const StrategyOptions& options) {
  return {passage.moving,
          ContactFinder(passage.moving, passage.stationary, passage.tolerances),
          {.velocity_error = errors.velocity,
           .radius = options.radius,
           .test = options.test,
           .friction = options.friction}};
}

Belief BeliefIn(const Pose& X_StationaryMoving, const FineMotionErrors& errors, double multiple) {
  Belief belief{.X_StationaryMoving = X_StationaryMoving,
                .errors = {},
                .kept = {},
                .tolerances = multiple * errors.tolerances};
  belief.errors.setZero(Eigen::NoChange, belief.tolerances.size() + kPoseDimensions);
  belief.errors.rightCols<kPoseDimensions>() = multiple * errors.pose.asDiagonal().toDenseMatrix();
  return belief;
}

FineMotionPlan SearchStrategy(const Passage& passage, const FineMotionErrors& errors,
                              const StrategyOptions& options) {
  FineMotionPlan best;
  int expanded = 0;
  int replayed = 0;
  TestComparison comparison;
  for (int round = 0; round < options.rounds; ++round) {
    const double multiple = kMultiples[static_cast<std::size_t>(round) % std::size(kMultiples)];
    for (const double enlarged : kEnlarged) {
      if (best.found) break;
      const FineMotionErrors larger = Enlarged(errors, enlarged);
      FineMotionPlan plan = Search(passage, larger, options, round, multiple, 1 / enlarged).Run();
      TellInSmaller(plan, enlarged);
      if (plan.absorbed >= 1) AbsorbWhatIsConfirmed(plan, passage, errors, options);
      plan.found = plan.absorbed >= 1;  // of the errors that were asked for
      if (plan.found) plan.obstacle.reset();
      expanded += plan.expanded;
      replayed += plan.replayed;
      comparison += plan.comparison;
      const bool tells_more = best.absorbed == 0 && !best.obstacle;
      if (plan.found || plan.absorbed > best.absorbed || tells_more) best = std::move(plan);
    }
  }
  best.expanded = expanded;
  best.replayed = replayed;
  best.comparison = comparison;
  return best;
}

}  // namespace assay::finemotion
