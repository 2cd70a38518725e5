#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "planner/base/random.h"
#include "planner/domain/problem/problem.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/plan/data/plan.h"
#include "tests/oracle/convex_solid.h"

// Tests the promises of certificates by executing a plan in numbers. Every error is drawn from its
// bounds, and often at their ends. Poses are plain 4x4 matrices and parts are convex solids. Only
// the certificates themselves are shared with planner/uncertainty.
//
// The physics is quasi-static:
// - A part on the table only slides and turns on it.
// - The first pad that touches a part pushes it. The part may turn by up to the length of the push
//   over twice its radius of gyration.
// - The pads then turn the part flush about one of the two contacts, in any alternation. They may
//   jam on the way if the line between the contacts is within both friction cones.
// - Closed pads hold firmly.
// - A guarded motion ends where the part meets the table or its seat.
// - A released part falls flat about one of the points on which it stands.
namespace assay::oracle {

using domain::PartId;
using geometry::Vector2;

constexpr double kRounding = 1e-9;  // metres, radians

struct CertifiedAction {
  plan::Action action;
  plan::Certificate certificate;
};

struct Execution {
  std::vector<std::string> contradictions;  // certificates that proved false
  bool completed = false;  // false if something unproved went wrong; the rest is then unknown
};

// Returns the rotation that takes one unit vector to another by the least angle.
inline geometry::Matrix3 LeastTurn(const Vector3& from, const Vector3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).normalized().toRotationMatrix();
}

inline Pose About(const Vector3& pivot, const geometry::Matrix3& rotation) {
  Pose turn = Pose::Identity();
  turn.linear() = rotation;
  turn.translation() = pivot - rotation * pivot;
  return turn;
}

// Returns the angle of the turn about the world's z, in radians.
inline double YawOf(const geometry::Matrix3& R) {
  return std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
}

// Draws errors from intervals. One world in three draws only ends, and one in three draws ends half
// of the time.
class ErrorDraws {
 public:
  explicit ErrorDraws(RandomStream& random) : random_(random), style_(random.Index(3)) {}

  double operator()(const Interval& range) {
    const bool at_end = style_ == 0 || (style_ == 1 && random_.Uniform() < 0.5);
    if (at_end) return random_.Index(2) == 0 ? range.low : range.high;
    return range.low + random_.Uniform() * (range.high - range.low);
  }
  double Share() { return (*this)({0, 1}); }
  bool Coin() { return random_.Index(2) == 0; }
  int Index(int count) { return random_.Index(count); }

 private:
  RandomStream& random_;
  int style_;
};

// Pads that close on a part, in the frame of the true hand. The grasp frame is the planned one,
// fixed in the part. Its y is normal to the two faces, which lie half the width to either side.
class ClosingPads {
 public:
  struct PartBetween {
    Pose X_HandGrasp;
    Vector3 up;           // the world's vertical, hand frame
    Vector3 center;       // of mass, hand frame
    double gyration = 0;  // radius about the vertical through the centre, metres
    double friction = 0;  // between pads and part
  };

  ClosingPads(const Vector2& half_extents, double width, PartBetween part, ErrorDraws& draw)
      : half_(half_extents), width_(width), part_(std::move(part)), draw_(draw) {}

  Pose Close() {
    Push();
    Align();
    return part_.X_HandGrasp;
  }

 private:
  struct Contacts {
    Vector3 left, right;  // contacts of the pads at +y and -y with the faces
  };

  Vector3 Normal() const { return part_.X_HandGrasp.linear().col(1); }

  // Returns where a face first meets its pad. That is the corner or edge of the pad over which the
  // face is highest.
  Vector3 HighestUnderPad(double side) {
    const Vector3 n = Normal();
    const auto end = [&](double slope, double half) {
      if (std::abs(slope) < 1e-12) return draw_({-half, half});
      return slope * side > 0 ? -half : half;
    };
    Vector3 p(end(n.x(), half_.x()), 0, end(n.z(), half_.y()));
    const double offset = n.dot(part_.X_HandGrasp.translation()) + side * width_ / 2;
    p.y() = (offset - n.x() * p.x() - n.z() * p.z()) / n.y();
    return p;
  }
  Contacts Touching() { return {HighestUnderPad(1), HighestUnderPad(-1)}; }

  void Move(const Pose& motion) {
    part_.X_HandGrasp = motion * part_.X_HandGrasp;
    part_.center = motion * part_.center;
  }
  void Turn(const Vector3& pivot, const Vector3& axis, double angle) {
    Move(About(pivot, Eigen::AngleAxisd(angle, axis).toRotationMatrix()));
  }
  void Center() {
    const Contacts at = Touching();
    Move(geometry::Translation(0, -(at.left.y() + at.right.y()) / 2, 0));
  }
  // Returns the turn about the vertical that makes the faces as flush as it can, in radians.
  double TurnToFlush() const {
    const auto level = [&](const Vector3& v) { return Vector3(v - part_.up.dot(v) * part_.up); };
    const Vector3 from = level(Normal()), to = level(Vector3::UnitY());
    return std::atan2(part_.up.dot(from.cross(to)), from.dot(to));
  }

  void Push() {
    const Contacts at = Touching();
    const double off = (at.left.y() + at.right.y()) / 2;
    const Vector3 contact = off > 0 ? at.left : at.right;
    const double most = std::abs(off) / (2 * part_.gyration);
    // The level direction along the pads. The centre of mass lags behind the contact.
    const Vector3 along = Vector3::UnitY().cross(part_.up).normalized();
    const double reach = std::abs(along.x()) * half_.x() + std::abs(along.z()) * half_.y();
    const double lever = along.dot(part_.center - contact);
    double turn = draw_.Share() * most * (lever * off > 0 ? 1 : -1);
    if (std::abs(along.dot(part_.center)) <= reach) {  // the part becomes flush and stays so
      const double flush = TurnToFlush();
      if (turn * flush < 0) turn = 0;
      turn = std::copysign(std::min(std::abs(turn), std::abs(flush)), flush);
    }
    Turn(contact, part_.up, turn);
    Center();
  }

  void Align() {
    const bool on_the_table = draw_.Coin();
    const int stages = 1 + draw_.Index(3);
    for (int stage = 0; stage < stages; ++stage) {
      if (CanJam() && draw_.Coin()) return;
      const double share = stage + 1 == stages ? 1 : draw_.Share();
      const Vector3 pivot = Pivot();
      if (on_the_table) {
        Turn(pivot, part_.up, share * TurnToFlush());
      } else {
        const Eigen::AngleAxisd all(LeastTurn(Normal(), Vector3::UnitY()));
        Turn(pivot, all.axis(), share * all.angle());
      }
      Center();
    }
    Move(About(Pivot(), LeastTurn(Normal(), Vector3::UnitY())));
    Center();
  }
  bool CanJam() {
    const Contacts at = Touching();
    const Vector3 line = (at.left - at.right).normalized();
    const double cone = std::cos(std::atan(part_.friction));
    return line.y() > cone && line.dot(Normal()) > cone;
  }
  Vector3 Pivot() {
    const Contacts at = Touching();
    return draw_.Coin() ? at.left : at.right;
  }

  Vector2 half_;
  double width_;
  PartBetween part_;
  ErrorDraws& draw_;
};

class ExecutedWorld {
 public:
  ExecutedWorld(const domain::Problem& problem, RandomStream& random)
      : problem_(problem), draw_(random) {
    for (const domain::Part& part : problem.parts) {
      const Vector3 d(draw_(part.error.x), draw_(part.error.y), draw_(part.error.z));
      const Pose X = part.X_WorldPart;
      parts_.push_back({Displaced(X, d, draw_(part.error.theta)), X, X, d.z()});
      solids_.push_back(SolidsOf(*part.model));
    }
  }

  Execution Execute(std::span<const CertifiedAction> actions) {
    int number = 0;
    for (const CertifiedAction& step : actions) {
      certificate_ = &step.certificate;
      place_ = fmt::format("step {}", ++number);
      const bool went_well = Act(step.action);
      if (!went_well) return execution_;
      for (const plan::ErrorSet& set : step.certificate.after) ExpectInside(set, "after");
      if (!execution_.contradictions.empty()) return execution_;
    }
    execution_.completed = true;
    return execution_;
  }

  // Commands the hand, with new errors, to X_FixedTool relative to the believed pose of the fixed
  // part. Returns the pose of the held part in the true frame of the fixed part.
  Pose HeldSeenBy(PartId fixed, const Pose& X_FixedTool) {
    const Pose X_WorldHeld = HandAt(body(fixed).belief * X_FixedTool) * X_HandPart_;
    return body(fixed).truth.inverse() * X_WorldHeld;
  }

 private:
  struct Body {
    Pose truth;
    Pose belief;
    Pose planned;
    double table = 0;  // height of the table under the part
  };

  static Pose Displaced(const Pose& X, const Vector3& d, double yaw) {
    Pose moved = X;
    moved.linear() = geometry::RotationZ(yaw).linear() * X.linear();
    moved.translation() += d;
    return moved;
  }

  Body& body(PartId part) { return parts_[part.index()]; }
  const domain::PartModel& model(PartId part) const { return *problem_.part(part).model; }
  const std::vector<ConvexSolid>& solids(PartId part) const { return solids_[part.index()]; }
  const domain::WorkcellRules& rules() const { return problem_.workcell->rules(); }

  Pose HandAt(const Pose& X_WorldCommanded) {
    commanded_ = X_WorldCommanded;
    const domain::PoseError& error = problem_.gripper_error;
    return X_WorldCommanded *
           geometry::Translation(draw_(error.x), draw_(error.y), draw_(error.z)) *
           geometry::RotationZ(draw_(error.theta));
  }

  // ---- Promises ----

  bool Promised(const std::string& condition) const {
    bool any = false;
    for (const auto& claim : certificate_->preconditions) {
      if (claim.condition.name() != condition) continue;
      if (!claim.holds()) return false;
      any = true;
    }
    return any;
  }
  // Returns true if the condition holds, so that the execution can go on. A condition that was
  // promised and does not hold is recorded as a contradiction.
  bool Require(const std::string& condition, double margin, const std::string& what) {
    if (margin > -kRounding) return true;
    if (Promised(condition)) Contradict(fmt::format("{}: {} by {}", condition, what, -margin));
    return false;
  }
  void Contradict(const std::string& what) {
    execution_.contradictions.push_back(fmt::format("{}: {}", place_, what));
  }
  void ExpectIn(const Interval& range, double value, const std::string& what) {
    if (value >= range.low - kRounding && value <= range.high + kRounding) return;
    Contradict(fmt::format("{} = {} not in [{}, {}]", what, value, range.low, range.high));
  }

  void ExpectInside(const plan::ErrorSet& set, const std::string& when) {
    const std::string name = problem_.part(set.part).name + " " + when + ": ";
    if (set.in_hand != (set.part == in_hand_)) return Contradict(name + "in hand or not");
    const std::array<double, 6> error = set.in_hand ? HeldErrorNow() : RestingErrorOf(set.part);
    const std::array<Interval, 6> ranges = {set.x, set.y, set.z, set.theta, set.tip, set.twist};
    const std::array<const char*, 6> words = {"x", "y", "z", "theta", "tip", "twist"};
    for (std::size_t i = 0; i < 6; ++i) ExpectIn(ranges[i], error[i], name + words[i]);
  }
  // Returns the error of the grasped point in the frame of the commanded hand. The rotation is R =
  // Rz(theta) Rx(tip) Ry(twist).
  std::array<double, 6> HeldErrorNow() const {
    const Pose X = commanded_.inverse() * hand_ * X_HandPart_ * hold_.X_PartTool;
    const Vector3 p = X.translation();
    const geometry::Matrix3 R = X.linear();
    return {p.x(),
            p.y(),
            p.z(),
            std::atan2(-R(0, 1), R(1, 1)),
            std::asin(R(2, 1)),
            std::atan2(-R(2, 0), R(2, 2))};
  }
  // Returns the error of the true pose relative to the believed one, in the world's axes.
  std::array<double, 6> RestingErrorOf(PartId part) {
    const Body& b = body(part);
    const Vector3 d = b.truth.translation() - b.belief.translation();
    return {d.x(), d.y(), d.z(), YawOf(b.truth.linear() * b.belief.linear().transpose()), 0, 0};
  }

  // ---- Grasps ----

  // Brings the hand to the part and closes the pads. Returns false if something unproved went
  // wrong.
  bool Grasp(PartId part, const plan::Hold& hold, const Pose& planned) {
    for (const plan::ErrorSet& set : certificate_->before) ExpectInside(set, "before");
    body(part).planned = planned;
    hand_ = HandAt(body(part).belief * hold.X_PartTool);
    const Pose X_HandGrasp = hand_.inverse() * body(part).truth * hold.X_PartTool;
    if (!Straddles(X_HandGrasp, hold.width) || !FingersAboveTable(body(part).table)) return false;
    if (!HandPasses(hand_, {part}, hold.width)) return false;
    if (!OpensBeside(hand_, part, body(part).truth)) return false;
    const domain::PartModel& of = model(part);
    const Vector3 up = hand_.linear().transpose() * Vector3::UnitZ();
    const Vector3 up_in_part = body(part).truth.linear().transpose() * Vector3::UnitZ();
    const Vector3 center = hand_.inverse() * (body(part).truth * of.mass().center);
    const double gyration =
        std::sqrt(up_in_part.dot(of.mass().inertia * up_in_part) / of.mass().mass);
    const Vector2 half = problem_.workcell->gripper().pad_half_extents();
    const Pose closed =
        ClosingPads(half, hold.width, {X_HandGrasp, up, center, gyration, rules().pad_friction},
                    draw_)
            .Close();
    X_HandPart_ = closed * hold.X_PartTool.inverse();
    hold_ = hold;
    const Vector2 g(closed.translation().x(), closed.translation().z());
    const double margin = (half - g.cwiseAbs()).minCoeff() - rules().pad_margin;
    return Require("pad contact", margin, "the grasped point lies outside the pads");
  }

  bool Straddles(const Pose& X_HandGrasp, double width) {
    const kinematics::Gripper& gripper = problem_.workcell->gripper();
    const double open = gripper.max_opening() / 2;
    for (double side : {-1.0, 1.0}) {
      const double y = (X_HandGrasp * Vector3(0, side * width / 2, 0)).y();
      if (!Require("between fingers", open - std::abs(y), "a contact is not between them")) {
        return false;
      }
      const Vector2 half = gripper.pad_half_extents();
      for (double x : {-half.x(), half.x()}) {
        for (double z : {-half.y(), half.y()}) {
          const Vector3 corner = X_HandGrasp.inverse() * Vector3(x, side * open, z);
          const double clear = side * corner.y() - width / 2;
          if (!Require("finger clear", clear, "a finger comes down on the part")) return false;
        }
      }
    }
    return true;
  }
  bool FingersAboveTable(double table) {
    const kinematics::Gripper& gripper = problem_.workcell->gripper();
    double lowest = std::numeric_limits<double>::infinity();
    for (const Box& box : gripper.FingerBoxes(gripper.max_opening())) {
      for (const Vector3& corner : box.Corners()) lowest = std::min(lowest, (hand_ * corner).z());
    }
    return Require("fingertip", lowest - table, "a finger goes through the table");
  }
  static bool AreFar(const ConvexSolid& a, const ConvexSolid& b) {
    const geometry::Ball of_a = geometry::BallAround(a.hull.vertices);
    const geometry::Ball of_b = geometry::BallAround(b.hull.vertices);
    return (of_a.center - of_b.center).norm() > of_a.radius + of_b.radius;
  }
  // Returns the least separation of a part from a solid of the hand; infinity if they are far
  // apart.
  double FromSolid(const ConvexSolid& of_hand, PartId part, const Pose& X_WorldPart) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ConvexSolid& solid : solids(part)) {
      const ConvexSolid of_part = solid.Transformed(X_WorldPart);
      if (!AreFar(of_hand, of_part)) nearest = std::min(nearest, Separation(of_hand, of_part));
    }
    return nearest;
  }
  // Returns the least separation of a part and the hand with its pads this far apart. The
  // separation is taken at a few places of the straight retreat from the hand's pose.
  double FromHand(const Pose& hand, double opening, PartId part, const Pose& X_WorldPart) const {
    const kinematics::Gripper& gripper = problem_.workcell->gripper();
    std::vector<Box> boxes = gripper.HandBoxes();
    for (const Box& box : gripper.FingerBoxes(opening)) boxes.push_back(box);
    double nearest = std::numeric_limits<double>::infinity();
    for (const double way : {0.0, 0.3, 0.7, 1.0}) {
      const Pose X = hand * geometry::Translation(0, 0, -way * rules().approach_distance);
      for (const ConvexSolid& of_hand : SolidsOf(boxes)) {
        nearest = std::min(nearest, FromSolid(of_hand.Transformed(X), part, X_WorldPart));
      }
    }
    return nearest;
  }
  // Requires that the hand, open or closed, is clear of all parts that it does not handle.
  bool HandPasses(const Pose& hand, const std::vector<PartId>& handled, double width) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const PartId other(static_cast<int>(i));
      if (std::ranges::find(handled, other) != handled.end()) continue;
      for (const double opening : {width, MostOpen()}) {
        nearest = std::min(nearest, FromHand(hand, opening, other, parts_[i].truth));
      }
    }
    return Keeps("hand clear", nearest, "the hand goes through a part");
  }
  // Requires that the open hand is clear of the part that it takes or releases.
  bool OpensBeside(const Pose& hand, PartId part, const Pose& X_WorldPart) {
    return Keeps("hand clear", FromHand(hand, MostOpen(), part, X_WorldPart),
                 "the open hand goes through the part that it handles");
  }
  double MostOpen() const { return problem_.workcell->gripper().max_opening(); }
  // Returns whether the bodies do not overlap. A negative separation contradicts the certificate,
  // unless the certificate has an unproved precondition of the kind `condition`.
  bool Keeps(const std::string& condition, double separation, const std::string& what) {
    if (separation > -kRounding) return true;
    const auto denied = [&](const plan::CertifiedPrecondition& claim) {
      return claim.condition.name() == condition && !claim.holds();
    };
    if (std::ranges::none_of(certificate_->preconditions, denied)) {
      Contradict(fmt::format("{}: {} by {}", condition, what, -separation));
    }
    return false;
  }

  bool Act(const plan::Action& action) {
    if (action.Is(domain::kPickup)) return Pickup(action);
    if (action.Is(domain::kSqueeze)) return Squeeze(action);
    if (action.Is(domain::kPutdown)) return Putdown(action);
    if (action.Is(domain::kSense)) return Sense(action);
    return Assemble(action);
  }

  bool Pickup(const plan::Action& pickup) {
    if (!Grasp(pickup.part, pickup.hold, pickup.place.X_WorldPart)) return false;
    in_hand_ = pickup.part;
    return true;
  }
  bool Squeeze(const plan::Action& squeeze) {
    if (!Grasp(squeeze.part, squeeze.hold, squeeze.place.X_WorldPart)) return false;
    Body& b = body(squeeze.part);
    b.truth = Settled(squeeze.part, hand_ * X_HandPart_, squeeze.place.X_WorldPart, b.table);
    return true;
  }

  // ---- Landing ----

  // Returns the points of the part on which it stands when its pose is `flat`.
  std::vector<Vector3> FeetOf(PartId part, const Pose& flat) const {
    std::vector<Vector3> feet;
    double lowest = std::numeric_limits<double>::infinity();
    for (const ConvexSolid& solid : solids(part)) {
      for (const Vector3& p : solid.hull.vertices) lowest = std::min(lowest, (flat * p).z());
    }
    for (const ConvexSolid& solid : solids(part)) {
      for (const Vector3& p : solid.hull.vertices) {
        if ((flat * p).z() < lowest + 1e-6) feet.push_back(p);
      }
    }
    return feet;
  }
  // Returns the pose of a part that is released at X and should stand as in `flat`. It turns about
  // a foot until it stands, keeps its yaw, and takes the table's height.
  Pose Settled(PartId part, const Pose& X, const Pose& flat, double table) {
    const std::vector<Vector3> feet = FeetOf(part, flat);
    const Vector3 up = (X.linear() * flat.linear().transpose()).col(2);
    const Vector3 foot = feet[static_cast<std::size_t>(draw_.Index(static_cast<int>(feet.size())))];
    Pose settled = About(X * foot, LeastTurn(up, Vector3::UnitZ())) * X;
    settled.translation().z() += table - (settled * feet[0]).z();
    return settled;
  }
  geometry::Polygon ShadowOf(PartId part, const Pose& X) const {
    std::vector<Vector2> points;
    for (const ConvexSolid& solid : solids(part)) {
      for (const Vector3& p : solid.hull.vertices) points.push_back((X * p).head<2>());
    }
    return geometry::Hull2(points);
  }

  bool Putdown(const plan::Action& putdown) {
    hand_ = HandAt(putdown.place.X_WorldPart * hold_.X_PartTool);
    for (const plan::ErrorSet& set : certificate_->before) ExpectInside(set, "before");
    const PartId part = putdown.part;
    const Pose flat = putdown.place.X_WorldPart;
    if (!HandPasses(hand_, {part}, hold_.width)) return false;
    const Pose X = hand_ * X_HandPart_;
    const double table = draw_(problem_.part(part).error.z);
    for (const Vector3& foot : FeetOf(part, flat)) {
      const double travel = std::abs((X * foot).z() - table);
      if (!Require("landing height", rules().guarded_travel - travel, "met too early or late")) {
        return false;
      }
    }
    const Pose settled = Settled(part, X, flat, table);
    if (!FreePlace(part, X) || !FreePlace(part, settled)) return false;
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vector3& foot : FeetOf(part, flat)) lowest = std::min(lowest, (X * foot).z());
    const Pose landed = geometry::Translation(0, 0, table - lowest) * hand_;
    if (!OpensBeside(landed, part, settled)) return false;
    body(part) = {settled, flat, flat, table};
    in_hand_ = PartId::None();
    return true;
  }
  bool FreePlace(PartId part, const Pose& X) {
    const geometry::Polygon shadow = ShadowOf(part, X);
    for (const Vector2& corner : shadow) {
      const double depth = geometry::Depth(problem_.workcell->table().top, corner);
      if (!Require("footprint", depth, "over the edge of the table")) return false;
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (PartId(static_cast<int>(i)) == part) continue;
      const auto other = ShadowOf(PartId(static_cast<int>(i)), parts_[i].truth);
      if (!Require("neighbour clear", geometry::Gap(shadow, other), "into a neighbour")) {
        return false;
      }
    }
    return true;
  }

  // ---- Sensing ----

  // If the sensor measures a coordinate better than it is known, the coordinate gets the measured
  // value.
  bool Sense(const plan::Action& sense) {
    const auto& sensor = *problem_.workcell->uncertainty_operations().FindSensor(sense.sensor);
    Body& b = body(sense.part);
    b.planned = sense.place.X_WorldPart;
    for (const plan::ErrorSet& set : certificate_->before) ExpectInside(set, "before");
    const plan::ErrorSet& known = certificate_->before.at(0);
    const auto better = [](const Interval& measured, const Interval& so_far) {
      return measured.high - measured.low < so_far.high - so_far.low;
    };
    Vector3 believed = b.belief.translation();
    if (better(sensor.x, known.x)) believed.x() = b.truth.translation().x() - draw_(sensor.x);
    if (better(sensor.y, known.y)) believed.y() = b.truth.translation().y() - draw_(sensor.y);
    if (better(sensor.z, known.z)) believed.z() = b.truth.translation().z() - draw_(sensor.z);
    double turn = 0;
    if (better(sensor.theta, known.theta)) {
      turn = YawOf(b.truth.linear() * b.belief.linear().transpose()) - draw_(sensor.theta);
    }
    b.belief = Displaced(b.belief, believed - b.belief.translation(), turn);
    return true;
  }

  // ---- Mating ----

  struct Seat {
    Vector3 point;      // of the held part, in its frame
    double height = 0;  // of the face that it meets, along the axis, in the frame of the fixed part
  };
  // Returns the corners of the held part that touch the fixed part in the mated pose, at faces that
  // stop the motion along the mating vector.
  std::vector<Seat> SeatsOf(const domain::Mating& mating) const {
    const Vector3 axis = mating.mating_vector.normalized();
    std::vector<Seat> seats;
    for (const ConvexSolid& held : solids(mating.held)) {
      for (const Vector3& corner : held.hull.vertices) {
        const Vector3 p = mating.X_FixedHeld * corner;
        for (const ConvexSolid& fixed : solids(mating.fixed)) {
          if (IsWithin(fixed.hull, p, 1e-6) && !IsWithin(fixed.hull, p - 1e-4 * axis, 1e-6)) {
            seats.push_back({corner, axis.dot(p)});
          }
        }
      }
    }
    return seats;
  }
  // Returns how far the held part must move along the axis until it sits. A negative value means
  // that it has gone too far.
  static double TravelToSeat(const std::vector<Seat>& seats, const Pose& X_FixedHeld,
                             const Vector3& axis) {
    double least = std::numeric_limits<double>::infinity();
    for (const Seat& seat : seats) {
      least = std::min(least, seat.height - axis.dot(X_FixedHeld * seat.point));
    }
    return least;
  }
  double LeastSeparation(const domain::Mating& mating, const Pose& X_FixedHeld) const {
    double least = std::numeric_limits<double>::infinity();
    for (const ConvexSolid& held : solids(mating.held)) {
      const ConvexSolid moved = held.Transformed(X_FixedHeld);
      for (const ConvexSolid& fixed : solids(mating.fixed)) {
        least = std::min(least, Separation(moved, fixed));
      }
    }
    return least;
  }
  static Pose Between(const Pose& a, const Pose& b, double t) {
    Pose between = Pose::Identity();
    between.linear() =
        Eigen::Quaterniond(a.linear()).slerp(t, Eigen::Quaterniond(b.linear())).toRotationMatrix();
    between.translation() = a.translation() + t * (b.translation() - a.translation());
    return between;
  }

  bool Assemble(const plan::Action& assemble) {
    const domain::Mating& mating = problem_.mating(assemble.mating);
    const Body fixed = body(mating.fixed);
    const Pose back = geometry::Translation(-mating.mating_vector);
    const Pose X_FixedTool = mating.X_FixedHeld * hold_.X_PartTool;
    const Pose X_FixedWorld = fixed.truth.inverse();
    const Pose from = HandAt(fixed.belief * back * X_FixedTool);
    const Pose begin = X_FixedWorld * from * X_HandPart_;
    hand_ = HandAt(fixed.belief * X_FixedTool);
    for (const plan::ErrorSet& set : certificate_->before) ExpectInside(set, "before");
    const Pose end = X_FixedWorld * hand_ * X_HandPart_;

    const Vector3 axis = mating.mating_vector.normalized();
    const std::vector<Seat> seats = SeatsOf(mating);
    const double travel = TravelToSeat(seats, end, axis);
    if (!Require("seat", rules().guarded_travel - std::abs(travel), "met too early or late") ||
        !SlidesIn(mating, begin, end)) {
      return false;
    }
    const Pose to = fixed.truth * geometry::Translation(travel * axis) * X_FixedWorld * hand_;
    if (!HandPasses(hand_, {mating.held, mating.fixed}, hold_.width) ||
        !HandComesIn(mating.fixed, from, to)) {
      return false;
    }
    // The released part sits flat on a corner of its seat.
    const Pose down = geometry::Translation(travel * axis) * end;
    const Seat& corner =
        seats[static_cast<std::size_t>(draw_.Index(static_cast<int>(seats.size())))];
    const Vector3 leaning = down.linear() * mating.X_FixedHeld.linear().transpose() * axis;
    Pose seated = About(down * corner.point, LeastTurn(leaning, axis)) * down;
    seated = geometry::Translation(TravelToSeat(seats, seated, axis) * axis) * seated;
    if (!OpensBeside(to, mating.held, fixed.truth * seated)) return false;
    body(mating.held) = {fixed.truth * seated, fixed.belief * mating.X_FixedHeld,
                         fixed.planned * mating.X_FixedHeld, 0};
    in_hand_ = PartId::None();
    return true;
  }

  // Requires that the hand is clear of the fixed part: with closed pads on the way in, and with
  // open pads at its end.
  bool HandComesIn(PartId fixed, const Pose& from, const Pose& to) {
    constexpr int kPlaces = 8;
    double nearest = FromHand(to, MostOpen(), fixed, body(fixed).truth);
    for (int i = 0; i <= kPlaces; ++i) {
      const Pose hand = Between(from, to, static_cast<double>(i) / kPlaces);
      for (const Box& box : problem_.workcell->gripper().FingerBoxes(hold_.width)) {
        const ConvexSolid finger = SolidOf(geometry::HullOf(box.Transformed(hand)));
        nearest = std::min(nearest, FromSolid(finger, fixed, body(fixed).truth));
      }
    }
    return Keeps("hand clear", nearest, "the hand goes through the fixed part");
  }

  bool SlidesIn(const domain::Mating& mating, const Pose& begin, const Pose& end) {
    const Vector3 axis = mating.mating_vector.normalized();
    const std::vector<Seat> seats = SeatsOf(mating);
    constexpr int kPlaces = 8;
    for (int i = 0; i <= kPlaces; ++i) {
      Pose X = Between(begin, end, static_cast<double>(i) / kPlaces);
      const double travel = TravelToSeat(seats, X, axis);
      if (travel < 0 || i == kPlaces) X = geometry::Translation(travel * axis) * X;
      const double clear = LeastSeparation(mating, X) + rules().lateral_compliance;
      if (clear > -kRounding) continue;
      if (Promised("entry") && Promised("slide-in") && Promised("tilt")) {
        Keeps("passing clear", clear, "on the way in the held part goes through the fixed one");
      }
      return false;
    }
    return true;
  }

  const domain::Problem& problem_;
  ErrorDraws draw_;
  std::vector<Body> parts_;
  std::vector<std::vector<ConvexSolid>> solids_;  // of each part, in its frame
  PartId in_hand_ = PartId::None();
  plan::Hold hold_;
  Pose hand_ = Pose::Identity();
  Pose commanded_ = Pose::Identity();
  Pose X_HandPart_ = Pose::Identity();
  const plan::Certificate* certificate_ = nullptr;
  std::string place_;
  Execution execution_;
};

// Executes the plan once with random errors.
inline Execution ExecuteOnce(const domain::Problem& problem,
                             std::span<const CertifiedAction> actions, RandomStream& random) {
  return ExecutedWorld(problem, random).Execute(actions);
}

}  // namespace assay::oracle
