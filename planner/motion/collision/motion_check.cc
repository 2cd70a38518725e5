#include "planner/motion/collision/motion_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <ranges>

#include "planner/base/check.h"
#include "planner/geometry/box.h"

namespace assay::motion {
namespace {

// The share of the distance in a given posture that must be kept in the rest of the motion.
constexpr double kShareOfGiven = 0.9;
constexpr double kFar = std::numeric_limits<double>::infinity();
// The greatest number of boxes of errors that are tested around one posture.
constexpr int kMostBoxes = 1'000;

double AngleBetweenUnits(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::string Describe(const CollisionScene& scene, const MotionRules& rules,
                     const Obstruction& obstruction) {
  switch (obstruction.kind) {
    case Obstruction::Kind::kLimits:
      return "a joint is out of its range";
    case Obstruction::Kind::kTilt:
      return fmt::format("the part that must stay upright leans more than {:.1f} deg",
                         rules.upright->tilt * 180 / M_PI);
    case Obstruction::Kind::kPair:
      return fmt::format("{} are nearer than {:.1f} mm", scene.Describe(obstruction.pair),
                         1e3 * obstruction.clearance);
  }
  ASSAY_CHECK(false, "no such kind of obstruction");
}

MotionCheck::MotionCheck(const CollisionScene& scene, const MotionRules& rules)
    : scene_(scene), rules_(rules) {
  ASSAY_CHECK(rules.clearance >= 0);
  for (const JointVector& q : rules.given) given_.push_back(scene.arm().LinkPoses(q));
  watched_ = WatchedPairs();
  if (!rules.upright) return;
  const domain::Workcell& workcell = scene.workcell();
  up_Flange_ = workcell.gripper().X_FlangeTool().linear() * rules.upright->up_Tool;
  up_Base_ = workcell.X_WorldBase().linear().transpose() * Vector3::UnitZ();
}

std::vector<MotionCheck::WatchedPair> MotionCheck::WatchedPairs() {
  std::vector<WatchedPair> watched;
  for (const BodyPair& pair : scene_.pairs()) {
    const bool carried = scene_.IsCarried(pair.second);
    const bool is_at_work = carried && !scene_.IsOfArm(pair.first);
    if (is_at_work && rules_.bodies == MotionRules::Bodies::kArm) continue;
    if (rules_.bodies == MotionRules::Bodies::kRobots && !scene_.IsOfAnotherRobot(pair.first)) {
      continue;
    }
    const PairErrors errors(scene_, pair, rules_.sway, rules_.tool);
    const bool is_own = scene_.IsOfRobot(pair.first) && scene_.IsOfRobot(pair.second);
    const double clearance = is_own ? std::min(kOwnClearance, rules_.clearance) : rules_.clearance;
    WatchedPair& added =
        watched.emplace_back(WatchedPair{pair, errors, clearance + errors.shift(), kFar});
    if (carried) HeedGivenPostures(added);
  }
  return watched;
}

void MotionCheck::HeedGivenPostures(WatchedPair& watched) {
  const double needed = watched.clearance + watched.errors.GreatestDisplacement();
  double most = kFar;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < given_.size(); ++i) {
    const double kept =
        kShareOfGiven * scene_.Separation(watched.pair, given_[i], needed / kShareOfGiven);
    if (kept == 0 || kept >= std::min(needed, most)) continue;
    most = kept;
    nearest = i;
  }
  if (most == kFar || LowerToCertainClearance(watched)) return;
  watched.most = most;
  const bool has_errors = watched.errors.GreatestDisplacement() + watched.errors.shift() > 0;
  if (!rules_.certain_clearance || IsAtWork(watched.pair)) return;
  if (!has_errors && most >= *rules_.certain_clearance) return;
  in_given_posture_ =
      Obstruction{Obstruction::Kind::kPair, watched.pair, watched.clearance, rules_.given[nearest]};
}

bool MotionCheck::LowerToCertainClearance(WatchedPair& watched) const {
  // Halving a motion decides a pair only if it keeps more than its clearance by this distance.
  constexpr double kRoom = 2 * kUndecidedOfErrors;
  constexpr double kStep = 0.7;  // ratio of the clearances that are tried
  const double least = rules_.certain_clearance.value_or(0) + kRoom;
  WatchedPair tried = watched;
  const auto is_clear_in = [&](const std::size_t i) {
    return LookAt(rules_.given[i], given_[i], 0, tried) == Verdict::kFree;
  };
  const auto given = std::views::iota(std::size_t{0}, given_.size());
  for (double kept = watched.clearance - watched.errors.shift(); kept > least; kept *= kStep) {
    tried.clearance = kept + watched.errors.shift();
    if (!std::ranges::all_of(given, is_clear_in)) continue;
    watched.clearance = tried.clearance - kRoom;
    return true;
  }
  return false;
}

bool MotionCheck::IsAtWork(const BodyPair& pair) const {
  const auto is_at_work = [&](BodyId id) {
    return std::ranges::count(rules_.at_work, scene_.body(id).identity.part) > 0;
  };
  return is_at_work(pair.first) || is_at_work(pair.second);
}

MotionCheck::Verdict MotionCheck::LookAt(const JointVector& q, const LinkPoses& X_BaseLink,
                                         double motion, WatchedPair& watched) const {
  struct Box {
    ErrorVector middle;
    ErrorVector half;
  };
  std::vector<Box> open;
  Box box = {ErrorVector::Zero(), watched.errors.greatest()};
  LinkPoses X_Box = X_BaseLink;
  double most = watched.most;
  for (int boxes = 0;; ++boxes) {
    const ErrorVector displacement = watched.errors.DisplacementIn(box.half, X_Box);
    const double displaced = displacement.sum();
    const double enough = watched.clearance + displaced + motion;
    const double needed = std::min(enough, most + motion);
    const double distance = scene_.Separation(watched.pair, X_Box, needed, watched.slabs);
    if (distance < std::min(watched.clearance, most) || distance == 0) {
      return watched.most < most ? Verdict::kOpen : Verdict::kObstructed;
    }
    // Without errors, this distance is no more than the one above.
    const bool may_be_near =
        distance < needed &&
        (displaced == 0 || watched.errors.DistanceIn(box.half, X_Box, watched.slabs, enough) <
                               watched.clearance + motion);
    if (may_be_near) {
      const bool is_open = distance < std::min(watched.clearance, most) + motion;
      if (is_open || displaced < std::max(motion, kUndecided) || boxes > kMostBoxes) {
        return Verdict::kOpen;
      }
      int widest = 0;
      displacement.maxCoeff(&widest);
      box.half[widest] /= 2;
      for (const double side : {-1, 1}) {
        open.push_back(box);
        open.back().middle[widest] += side * box.half[widest];
      }
    }
    if (open.empty()) return Verdict::kFree;
    box = open.back();
    open.pop_back();
    X_Box = watched.errors.PosesWith(box.middle, q, X_BaseLink);
    most = kFar;
  }
}

double MotionCheck::Tilt(const LinkPoses& X_BaseLink) const {
  return AngleBetweenUnits(X_BaseLink.back().linear() * up_Flange_, up_Base_);
}

std::optional<Obstruction> MotionCheck::FindObstruction(const JointVector& from,
                                                        const JointVector& to) {
  for (const JointVector& q : {from, to}) {  // the range is convex: its ends are enough
    if (!scene_.arm().InRange(q)) return Obstruction{Obstruction::Kind::kLimits, {}, 0, q};
  }
  if (in_given_posture_) return in_given_posture_;
  const JointVector way = to - from;
  const JointVector turn = way.cwiseAbs();
  // The search is breadth first, so that an obstruction is found soon.
  std::deque<Interval> intervals = {{0.5, 0.5, OpenPairs(turn), rules_.upright.has_value()}};
  while (!intervals.empty()) {
    const JointVector q = from + intervals.front().middle * way;
    if (std::optional<Obstruction> obstruction = Narrow(intervals.front(), q, turn.sum())) {
      return obstruction;
    }
    const Interval rest = std::move(intervals.front());
    intervals.pop_front();
    if (rest.pairs.empty() && !rest.tilt_is_open) continue;
    for (const double middle : {rest.middle - rest.half / 2, rest.middle + rest.half / 2}) {
      intervals.push_back({middle, rest.half / 2, rest.pairs, rest.tilt_is_open});
    }
  }
  return std::nullopt;
}

std::vector<MotionCheck::OpenPair> MotionCheck::OpenPairs(const JointVector& turn) {
  std::vector<OpenPair> open;
  for (WatchedPair& watched : watched_) {
    open.push_back({&watched, watched.errors.GreatestMotion(turn)});
  }
  return open;
}

std::optional<Obstruction> MotionCheck::Narrow(Interval& interval, const JointVector& q,
                                               double turn) {
  ++postures_;
  const LinkPoses X_BaseLink = scene_.arm().LinkPoses(q);
  if (interval.tilt_is_open) {
    const double room = rules_.upright->tilt - Tilt(X_BaseLink);
    const double turn_from_middle = turn * interval.half;
    interval.tilt_is_open = room < turn_from_middle;
    if (room < 0 || (interval.tilt_is_open && turn_from_middle < kUndecided)) {
      return Obstruction{Obstruction::Kind::kTilt, {}, 0, q};
    }
  }
  std::vector<OpenPair> still_open;
  for (const OpenPair& open : interval.pairs) {
    WatchedPair& watched = *open.watched;
    const double motion = open.motion * interval.half;
    const Verdict verdict = LookAt(q, X_BaseLink, motion, watched);
    if (verdict == Verdict::kFree) continue;
    const bool has_errors = !watched.errors.greatest().isZero(0);
    const double undecided = has_errors ? kUndecidedOfErrors : kUndecided;
    if (verdict == Verdict::kObstructed || motion < undecided) {
      return Obstruction{Obstruction::Kind::kPair, watched.pair,
                         std::min(watched.clearance, watched.most), q};
    }
    still_open.push_back(open);
  }
  interval.pairs = std::move(still_open);
  return std::nullopt;
}

}  // namespace assay::motion
