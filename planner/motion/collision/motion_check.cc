#include "planner/motion/collision/motion_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "planner/base/check.h"
#include "planner/geometry/box.h"

namespace assay::motion {
namespace {

// The share of the distance in a given posture that must be kept in the rest of the motion.
constexpr double kShareOfGiven = 0.9;
constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr int kFirstOfWrist = 4;  // link of the arm: the axes beyond it meet in one point
constexpr int kLastLink = 6;      // the flange, with which the tool moves
// The greatest number of boxes in the space of joint angles that are tested around one posture.
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
  const plan::ToolErrorBox& tool = rules_.tool;
  const bool may_err = tool.turn > 0 || tool.spin > 0 || !tool.shift.isZero(0);
  std::vector<WatchedPair> watched;
  for (const BodyPair& pair : scene_.pairs()) {
    const bool carried = scene_.IsCarried(pair.second);
    if (carried && rules_.bodies == MotionRules::Bodies::kArm) continue;
    if (rules_.bodies == MotionRules::Bodies::kRobots && !scene_.IsOfAnotherRobot(pair.first)) {
      continue;
    }
    WatchedPair& added = watched.emplace_back(Watched(pair));
    if (!carried) continue;
    const double enough = may_err ? kFar : added.clearance;
    for (const LinkPoses& X_BaseLink : given) {
      const double near = kShareOfGiven * scene_.Separation(pair, X_BaseLink, enough);
      if (near > 0) added.most = std::min(added.most, near);
    }
  }
  return watched;
}

MotionCheck::WatchedPair MotionCheck::Watched(const BodyPair& pair) const {
  const Body& first = scene_.body(pair.first);
  const Body& second = scene_.body(pair.second);
  WatchedPair watched{
      .pair = pair, .clearance = rules_.clearance + first.doubt + second.doubt, .most = kFar};
  watched.is_seen_from_tool = first.link == 0 && second.link >= kFirstOfWrist;
  if (!watched.is_seen_from_tool) {
    for (int k = first.link; k < second.link; ++k) {
      watched.sway[k] = rules_.sway[k];
      watched.reach[k] = second.reach[k];
    }
    return watched;
  }
  const LinkPoses X_BaseLink = scene_.arm().LinkPoses(JointVector::Zero());
  const Vector3 wrist = X_BaseLink.back() * Vector3(0, 0, -scene_.arm().geometry().d6);
  const Vector3 center = X_BaseLink[second.link] * second.center;
  for (int k = second.link; k < kLastLink; ++k) {
    watched.sway[k] = rules_.sway[k];
    watched.reach[k] = (center - wrist).norm() + second.ball_radius;
  }
  return watched;
}

double MotionCheck::ErrorOfTool(const Body& body, const LinkPoses& X_BaseLink, double near) const {
  const plan::ToolErrorBox& tool = rules_.tool;
  if (tool.turn == 0 && tool.spin == 0) return tool.shift.norm();
  const domain::Workcell& workcell = scene_.workcell();
  const Pose X_WorldTool =
      workcell.X_WorldBase() * X_BaseLink.back() * workcell.gripper().X_FlangeTool();
  const Pose X_WorldBody = workcell.X_WorldBase() * X_BaseLink[body.link];
  double from_vertical = 0;  // distance from the vertical through the tool's origin
  double from_axis = 0;      // distance from the tool's axis
  for (const RoundedHull& hull : body.hulls) {
    for (const Vector3& vertex : hull.vertices()) {
      const Vector3 from_tool = X_WorldBody * vertex - X_WorldTool.translation();
      const double across = (X_WorldTool.linear().transpose() * from_tool).head<2>().norm();
      from_vertical = std::max(from_vertical, from_tool.head<2>().norm() + hull.radius());
      from_axis = std::max(from_axis, across + hull.radius());
    }
  }
  const double spun = tool.spin * (from_axis + near);
  return tool.shift.norm() + tool.turn * (from_vertical + near + spun) + spun;
}

LinkPoses MotionCheck::Swayed(const WatchedPair& watched, const JointVector& q,
                              const LinkPoses& X_BaseLink, const JointVector& offset) const {
  LinkPoses swayed = scene_.arm().LinkPoses(q + offset);
  if (!watched.is_seen_from_tool) return swayed;
  const Pose X_Tool = X_BaseLink.back() * swayed.back().inverse();
  for (Pose& X : swayed) X = X_Tool * X;
  return swayed;
}

MotionCheck::Verdict MotionCheck::LookAt(const JointVector& q, const LinkPoses& X_BaseLink,
                                         double motion, WatchedPair& watched) const {
  struct Box {
    JointVector offset;  // the box's middle, from q
    JointVector half;
  };
  std::vector<Box> open;
  Box box = {JointVector::Zero(), watched.sway};
  const LinkPoses* X_Box = &X_BaseLink;
  LinkPoses X_Swayed;
  for (int boxes = 0;; ++boxes) {
    const double swayed = box.half.dot(watched.reach);
    double least = watched.clearance;
    if (watched.is_seen_from_tool) {
      least += ErrorOfTool(scene_.body(watched.pair.second), *X_Box, motion + swayed);
    }
    least = std::min(least, watched.most);
    const double needed = least + motion + swayed;
    const double distance = scene_.Separation(watched.pair, *X_Box, needed, watched.slabs);
    if (distance == 0 || distance < least) return Verdict::kObstructed;
    if (distance < needed) {
      if (swayed < std::max(motion, kUndecided) || boxes > kMostBoxes) return Verdict::kOpen;
      int widest = 0;
      box.half.cwiseProduct(watched.reach).maxCoeff(&widest);
      box.half[widest] /= 2;
      for (const double side : {-1, 1}) {
        open.push_back(box);
        open.back().offset[widest] += side * box.half[widest];
      }
    }
    if (open.empty()) return Verdict::kFree;
    box = open.back();
    open.pop_back();
    X_Swayed = Swayed(watched, q, X_BaseLink, box.offset);
    X_Box = &X_Swayed;
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
    WatchedPair& watched = *open.watched;
    const double motion = open.motion * interval.half;
    const Verdict verdict = LookAt(q, X_BaseLink, motion, watched);
    if (verdict == Verdict::kFree) continue;
    const double undecided = watched.sway.isZero(0) ? kUndecided : kUndecidedOfSway;
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
