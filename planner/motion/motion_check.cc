#include "planner/motion/motion_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "planner/base/check.h"

namespace assay::motion {
namespace {

// Of the distance in a given posture, what must be kept elsewhere.
constexpr double kShareOfGiven = 0.9;

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
      return fmt::format("what is to be kept upright leans more than {:.1f} deg",
                         rules.upright->tilt * 180 / M_PI);
    case Obstruction::Kind::kPair:
      return fmt::format("{} are nearer than {:.1f} mm", scene.Describe(obstruction.pair),
                         1e3 * obstruction.clearance);
  }
  ASSAY_CHECK(false, "no such kind of obstruction");
}

MotionCheck::MotionCheck(const CollisionScene& scene, const MotionRules& rules)
    : scene_(scene), rules_(rules), watched_(WatchedPairs()) {
  ASSAY_CHECK(rules.clearance >= 0);
  if (!rules.upright) return;
  const domain::Workcell& workcell = scene.workcell();
  up_Flange_ = workcell.gripper().X_FlangeTool().linear() * rules.upright->up_Tool;
  up_Base_ = workcell.X_WorldBase().linear().transpose() * Vector3::UnitZ();
}

std::vector<MotionCheck::WatchedPair> MotionCheck::WatchedPairs() const {
  std::vector<LinkPoses> given;
  for (const JointVector& q : rules_.given) given.push_back(scene_.arm().LinkPoses(q));
  std::vector<WatchedPair> watched;
  for (const BodyPair& pair : scene_.pairs()) {
    const bool carried = scene_.IsCarried(pair.second);
    if (carried && rules_.bodies == MotionRules::Bodies::kArm) continue;
    if (rules_.bodies == MotionRules::Bodies::kRobots && !scene_.IsOfAnotherRobot(pair.first)) {
      continue;
    }
    double clearance = rules_.clearance + ErrorsOf(pair);
    if (carried) {
      for (const LinkPoses& X_BaseLink : given) {
        const double near = kShareOfGiven * scene_.Separation(pair, X_BaseLink, clearance);
        if (near > 0) clearance = std::min(clearance, near);
      }
    }
    watched.push_back({pair, clearance});
  }
  return watched;
}

double MotionCheck::ErrorsOf(const BodyPair& pair) const {
  const Body& first = scene_.body(pair.first);
  const Body& second = scene_.body(pair.second);
  double errors = first.doubt + second.doubt;
  if (!scene_.IsCarried(pair.second)) return errors + scene_.GreatestMotion(pair, rules_.sway);
  for (int k = 0; k < first.link; ++k) errors += rules_.sway[k] * first.reach[k];
  return errors + rules_.carried_sway;
}

double MotionCheck::Tilt(const LinkPoses& X_BaseLink) const {
  return AngleBetweenUnits(X_BaseLink.back().linear() * up_Flange_, up_Base_);
}

std::optional<Obstruction> MotionCheck::FindObstruction(const JointVector& from,
                                                        const JointVector& to) {
  for (const JointVector& q : {from, to}) {  // the range is convex: its ends are enough
    if (!scene_.arm().InRange(q)) return Obstruction{Obstruction::Kind::kLimits, {}, 0, q};
  }
  const JointVector way = to - from;
  const JointVector turn = way.cwiseAbs();
  // Breadth first: what is in the way is seen soon.
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
    open.push_back({&watched, scene_.GreatestMotion(watched.pair, turn)});
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
    auto& [pair, clearance, slabs] = *open.watched;
    const double motion = open.motion * interval.half;
    const double needed = clearance + motion;
    const double distance = scene_.Separation(pair, X_BaseLink, needed, slabs);
    if (distance > 0 && distance >= needed) continue;
    if (distance == 0 || distance < clearance || motion < kUndecided) {
      return Obstruction{Obstruction::Kind::kPair, pair, clearance, q};
    }
    still_open.push_back(open);
  }
  interval.pairs = std::move(still_open);
  return std::nullopt;
}

}  // namespace assay::motion
