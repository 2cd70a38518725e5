#include "planner/domain/matings/mating_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/problem/name.h"
#include "planner/domain/problem/part_name.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

constexpr double kFeatureOffset = 0.001;  // metres by which mating features may be off their axis
constexpr double kShortestMatingVector = 1e-6;  // metres
constexpr double kLongestMatingVector = 2;      // metres
constexpr double kSamePose = 1e-9;      // greatest difference between entries of equal poses
constexpr double kMatingStep = 0.005;   // metres between tests along a mating vector
constexpr double kLeastDepth = 1e-4;    // metres that a shaft must be in its hole
constexpr double kBeforeMouth = 0.005;  // least distance from tip to mouth at the start, metres
constexpr double kBesideWall = 1e-6;    // depth in a wall that counts as rounding, metres
constexpr double kMostTurn = 0.4;       // greatest turn of a seated part that is tried, radians
constexpr double kPlayShare = 0.98;     // share of the play within which nothing else may be met
constexpr double kAxisTurn = 1e-3;      // greatest angle between axes that should be equal, radians

std::string NameOf(const Feature& feature) {
  return fmt::format("{} ({})", feature.number.index(), feature.description);
}

FeatureNumber ReadFeature(const Value& value, const Part& part) {
  const FeatureNumber number(value.Integer(0, 9999));
  if (part.model->FindFeature(number) != nullptr) return number;
  std::vector<std::string> known;
  for (const Feature& feature : part.model->features()) {
    known.push_back(NameOf(feature));
  }
  value.Fail(fmt::format("part '{}' has no feature {}", part.name, number.index()),
             fmt::format("{}", fmt::join(known, ", ")));
}

// The ways in which two features can meet. A mating needs a shaft in a hole, because nothing is
// proved about faces that come to lie on each other. In addition, it may have holes that are in
// line.
enum class Meeting { kShaftInHole, kHolesInLine, kFaceOnFace, kNone };

Meeting MeetingOf(const Feature& a, const Feature& b) {
  const bool a_is_hole = !a.mouths.empty();
  const bool b_is_hole = !b.mouths.empty();
  if (a_is_hole && b_is_hole) return Meeting::kHolesInLine;
  if (a.is_plain_face() && b.is_plain_face()) return Meeting::kFaceOnFace;
  if (a.is_plain_face() || b.is_plain_face() || a_is_hole == b_is_hole) return Meeting::kNone;
  return Meeting::kShaftInHole;
}

// Returns the features of the part that fit the given feature, as text.
std::string FeaturesFor(const Feature& feature, const Part& part) {
  std::vector<std::string> names;
  for (const Feature& other : part.model->features()) {
    if (MeetingOf(feature, other) != Meeting::kNone) names.push_back(NameOf(other));
  }
  return names.empty() ? "another feature: this feature fits no feature of the other part"
                       : fmt::format("{}", fmt::join(names, ", "));
}

bool IsSameMating(const Mating& a, const Mating& b) {
  return a.held == b.held && a.fixed == b.fixed && a.features == b.features &&
         a.X_FixedHeld.isApprox(b.X_FixedHeld, kSamePose) &&
         (a.mating_vector - b.mating_vector).norm() < kSamePose;
}

class MatingFile {
 public:
  MatingFile(const Problem& problem, const Units& units) : problem_(problem), units_(units) {}

  Mating Read(const Value& value) const;

 private:
  void ReadFeatures(const Value& features, Mating& mating) const;
  void CheckPair(const Value& place, const Mating& mating) const;
  Vector3 ReadMatingVector(const Value& value) const;
  void CheckFits(const Value& value, const Mating& mating) const;
  void CheckFeaturesMeet(const Value& value, const Mating& mating) const;
  void CheckFacesMeet(const Value& pose, const Mating& mating) const;
  void CheckShaftIsInside(const Value& value, const ShaftFit& fit) const;
  void CheckWayIn(const Value& vector, const Mating& mating, const ShaftFit& fit) const;
  void StartBeforeMouths(const Value& value, Mating& mating) const;
  bool EndsOnTable(const Value& pose, const Mating& mating) const;
  void CheckNothingElseFits(const Value& features, const Mating& mating) const;
  std::string InFileUnit(double metres) const { return InUnit(metres, units_.length); }

  const Problem& problem_;
  const Units& units_;
};

Mating MatingFile::Read(const Value& value) const {
  value.AllowOnly({"held", "fixed", "features", "pose", "mating_vector"});
  Mating mating;
  mating.held = ReadPartName(value.At("held"), problem_);
  mating.fixed = ReadPartName(value.At("fixed"), problem_);
  if (mating.held == mating.fixed) {
    value.At("fixed").Fail(
        fmt::format("part '{}' is to be mated with itself", problem_.part(mating.held).name),
        "two parts");
  }
  ReadFeatures(value.At("features"), mating);
  const Value pose = value.At("pose");
  pose.AllowOnly({"columns"});
  mating.X_FixedHeld = ReadColumns(pose.At("columns"), units_);
  mating.mating_vector = ReadMatingVector(value.At("mating_vector"));
  CheckFits(value, mating);
  CheckFeaturesMeet(value, mating);
  CheckFacesMeet(value.At("pose"), mating);
  for (const ShaftFit& fit : FitsOf(problem_, mating)) {
    CheckShaftIsInside(value, fit);
    CheckWayIn(value.At("mating_vector"), mating, fit);
  }
  StartBeforeMouths(value, mating);
  mating.ends_on_table = EndsOnTable(value.At("pose"), mating);
  CheckNothingElseFits(value.At("features"), mating);
  return mating;
}

void MatingFile::ReadFeatures(const Value& features, Mating& mating) const {
  const std::vector<Value> lists = features.Items();
  if (lists.size() != 2 || lists[0].Items().size() != lists[1].Items().size() ||
      lists[0].Items().empty()) {
    features.Fail("the features do not pair",
                  "[[of the held part], [of the fixed part]], as many of each");
  }
  const std::vector<Value> held = lists[0].Items();
  const std::vector<Value> fixed = lists[1].Items();
  for (std::size_t i = 0; i < held.size(); ++i) {
    mating.features.emplace_back(ReadFeature(held[i], problem_.part(mating.held)),
                                 ReadFeature(fixed[i], problem_.part(mating.fixed)));
    CheckPair(held[i], mating);
  }
}

// Checks the last pair of the mating.
void MatingFile::CheckPair(const Value& place, const Mating& mating) const {
  const auto& pair = mating.features.back();
  const Part& held_part = problem_.part(mating.held);
  const Part& fixed_part = problem_.part(mating.fixed);
  const Feature& held = *held_part.model->FindFeature(pair.first);
  const Feature& fixed = *fixed_part.model->FindFeature(pair.second);
  if (std::ranges::count(mating.features, pair) > 1) {
    place.Fail(fmt::format("feature {} of {} meets feature {} of {} twice", NameOf(held),
                           held_part.name, NameOf(fixed), fixed_part.name),
               "each pair of features once");
  }
  if (MeetingOf(held, fixed) != Meeting::kNone) return;
  place.Fail(fmt::format("feature {} of {} cannot meet feature {} of {}", NameOf(held),
                         held_part.name, NameOf(fixed), fixed_part.name),
             fmt::format("for feature {} of {}: {}", held.number.index(), held_part.name,
                         FeaturesFor(held, fixed_part)));
}

Vector3 MatingFile::ReadMatingVector(const Value& value) const {
  const Vector3 vector = ReadVector3(value, units_);
  if (vector.norm() < kShortestMatingVector) {
    value.Fail("the mating vector is zero", "the way from where the mating starts");
  }
  if (vector.norm() > kLongestMatingVector) {
    value.Fail(fmt::format("the mating vector is {} long", InFileUnit(vector.norm())),
               fmt::format("at most {}", InFileUnit(kLongestMatingVector)));
  }
  return vector;
}

// Checks that the parts, moved along the mating vector, fit into each other.
void MatingFile::CheckFits(const Value& value, const Mating& mating) const {
  const auto& held = problem_.part(mating.held).model->shape();
  const auto& fixed = problem_.part(mating.fixed).model->shape();
  const double allowance = problem_.workcell->rules().contact_allowance;
  const int steps = static_cast<int>(std::ceil(mating.mating_vector.norm() / kMatingStep));
  for (int i = 0; i <= steps; ++i) {
    const double before_end = static_cast<double>(i) / steps;
    const Pose X_FixedHeld =
        geometry::Translation(-before_end * mating.mating_vector) * mating.X_FixedHeld;
    if (!Overlaps(held, X_FixedHeld, fixed, Pose::Identity(), allowance)) continue;
    const std::string allowed = fmt::format("an overlap of at most {}", InFileUnit(allowance));
    if (i == 0) value.At("pose").Fail("the parts overlap in the mated pose", allowed);
    value.At("mating_vector")
        .Fail(fmt::format("the parts overlap on the way, {} before its end",
                          InFileUnit(before_end * mating.mating_vector.norm())),
              allowed);
  }
}

// Checks that shafts and holes that mate lie on one axis, within what the clearance leaves open.
void MatingFile::CheckFeaturesMeet(const Value& value, const Mating& mating) const {
  for (const auto& [of_held, of_fixed] : mating.features) {
    const Feature& held = *problem_.part(mating.held).model->FindFeature(of_held);
    const Feature& fixed = *problem_.part(mating.fixed).model->FindFeature(of_fixed);
    if (held.is_plain_face() || fixed.is_plain_face()) continue;
    const Vector3 offset =
        fixed.X_PartFeature.inverse() * mating.X_FixedHeld * held.X_PartFeature.translation();
    const double beside = offset.head<2>().norm();
    const double most = problem_.clearance + kFeatureOffset;
    if (beside <= most) continue;
    value.At("features")
        .Fail(fmt::format("in the mated pose feature {} lies {} beside feature {}", of_held.index(),
                          InFileUnit(beside), of_fixed.index()),
              fmt::format("features whose axes are at most {} apart", InFileUnit(most)));
  }
}

// Checks that faces that meet have opposite normals, and lie in one plane.
void MatingFile::CheckFacesMeet(const Value& pose, const Mating& mating) const {
  for (const auto& [of_held, of_fixed] : mating.features) {
    const Feature& held = *problem_.part(mating.held).model->FindFeature(of_held);
    const Feature& fixed = *problem_.part(mating.fixed).model->FindFeature(of_fixed);
    if (MeetingOf(held, fixed) != Meeting::kFaceOnFace) continue;
    const Pose X_FixedHeld =
        fixed.X_PartFeature.inverse() * mating.X_FixedHeld * held.X_PartFeature;
    if (X_FixedHeld(2, 2) < -std::cos(kAxisTurn) && std::abs(X_FixedHeld(2, 3)) <= kSeatGap) {
      continue;
    }
    pose.Fail(
        fmt::format("faces {} and {} do not lie on each other", of_held.index(), of_fixed.index()),
        fmt::format("faces that look at each other, at most {} apart", InFileUnit(kSeatGap)));
  }
}

// Checks that the seated shaft points into the hole, is behind its mouth, and is between its walls.
void MatingFile::CheckShaftIsInside(const Value& value, const ShaftFit& fit) const {
  const Value pose = value.At("pose");
  const Pose X_MouthTip =
      fit.hole.X_PartFeature.inverse() * fit.X_HoleShaft * fit.shaft.X_PartFeature;
  if (X_MouthTip(2, 2) > -std::cos(kAxisTurn)) {
    pose.Fail(fmt::format("{} does not point along the hole", fit.name),
              "a shaft whose axis is the hole's, towards its inside");
  }
  if (fit.depth < kLeastDepth) {
    pose.Fail(fmt::format("{} ends {} before the mouth", fit.name, InFileUnit(X_MouthTip(2, 3))),
              "a mated pose with the tip behind the mouth");
  }
  const geometry::Polygon section = CrossSection(fit);
  const std::vector<SideWall> walls = SideWalls(fit, 0);
  if (section.empty() || walls.empty()) {
    value.At("features")
        .Fail(fmt::format("{} has {}", fit.name,
                          section.empty() ? "no end face" : "no walls along the hole"),
              "shafts with an end face, and holes with walls");
  }
  for (const SideWall& wall : walls) {
    const double out = wall.offset - ExtentOf(fit, section, wall.normal).low;
    if (out <= kBesideWall) continue;
    pose.Fail(fmt::format("{} is {} inside a wall", fit.name, InFileUnit(out)),
              "a shaft between the walls of its hole");
  }
}

// Checks that the motion goes along the hole, all the way from before its mouth, since this is what
// the certificates cover.
void MatingFile::CheckWayIn(const Value& vector, const Mating& mating, const ShaftFit& fit) const {
  const Vector3 outward = fit.hole.X_PartFeature.linear().col(2);
  const Vector3 in = fit.shaft_is_held ? Vector3(-outward) : mating.X_FixedHeld.linear() * outward;
  const double length = mating.mating_vector.norm();
  if (in.dot(mating.mating_vector) < std::cos(kAxisTurn) * length) {
    vector.Fail(fmt::format("the motion does not go along the hole of {}", fit.name),
                fmt::format("a vector along [{:.4g}, {:.4g}, {:.4g}]", in.x() + 0.0, in.y() + 0.0,
                            in.z() + 0.0));
  }
  if (length < fit.depth - kBesideWall) {
    vector.Fail(fmt::format("the motion starts with {} already {} inside", fit.name,
                            InFileUnit(fit.depth - length)),
                fmt::format("at least {}", InFileUnit(fit.depth)));
  }
}

// Lengthens a mating vector at whose start a tip is so near to its mouth that the hand cannot bring
// the held part there clear of the fixed part.
void MatingFile::StartBeforeMouths(const Value& value, Mating& mating) const {
  double least = 0;
  for (const ShaftFit& fit : FitsOf(problem_, mating)) {
    least = std::max(least, fit.depth + kBeforeMouth);
  }
  if (mating.mating_vector.norm() >= least) return;
  mating.mating_vector *= least / mating.mating_vector.norm();
  CheckFits(value, mating);
}

// Checks that the motion ends at a contact where the part is to be, because a guarded move feels
// for it. Returns whether this contact is the table. It is the table if nothing of the fixed part
// is ahead, and if the held part is level with that side of the fixed part which lies on the table
// when the motion goes straight down.
bool MatingFile::EndsOnTable(const Value& pose, const Mating& mating) const {
  const PartModel& held = *problem_.part(mating.held).model;
  const PartModel& fixed = *problem_.part(mating.fixed).model;
  const double allowance = problem_.workcell->rules().contact_allowance;
  const Vector3 in = mating.mating_vector.normalized();
  if (Overlaps(held.shape(),
               geometry::Translation((allowance + kSeatGap) * in) * mating.X_FixedHeld,
               fixed.shape(), Pose::Identity(), allowance)) {
    return false;
  }
  const auto farthest = [&](const PartModel& model, const Pose& X_FixedPart) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3& p : model.corners()) most = std::max(most, in.dot(X_FixedPart * p));
    return most;
  };
  const double beyond = farthest(held, mating.X_FixedHeld) - farthest(fixed, Pose::Identity());
  if (std::abs(beyond) <= kSeatGap) return true;
  pose.Fail(
      "the parts do not touch where the mating motion ends",
      fmt::format("a mated pose in which the fixed part is at most {} ahead, or in which the "
                  "held part is level with the far side of the fixed part, where the table is",
                  InFileUnit(kSeatGap)));
}

// Returns poses of the seated held part in which its shafts and holes have almost all the play that
// the features leave: to both sides across each pair of walls, and turned about the mating motion.
std::vector<Pose> PosesWithinPlay(const Problem& problem, const Mating& mating) {
  const std::vector<ShaftFit> fits = FitsOf(problem, mating);
  std::vector<Pose> poses;
  if (fits.empty()) return poses;
  for (const auto& [across, low, high] : GapsOf(problem, mating)) {
    poses.push_back(geometry::Translation(kPlayShare * high * across) * mating.X_FixedHeld);
    poses.push_back(geometry::Translation(-kPlayShare * low * across) * mating.X_FixedHeld);
  }
  const ShaftFit& first = fits.front();
  const Vector3 about = first.shaft_is_held
                            ? Vector3(first.hole.X_PartFeature.translation())
                            : mating.X_FixedHeld * first.hole.X_PartFeature.translation();
  const Vector3 axis = mating.mating_vector.normalized();
  for (const double sense : {-1.0, 1.0}) {
    const auto turned = [&](double by) {
      return geometry::Translation(about) * Pose(Eigen::AngleAxisd(sense * by, axis)) *
             geometry::Translation(-about) * mating.X_FixedHeld;
    };
    double inside = 0;
    double outside = kMostTurn;
    for (int i = 0; i < 12; ++i) {
      const double middle = (inside + outside) / 2;
      (FitsInside(fits, turned(middle)) ? inside : outside) = middle;
    }
    poses.push_back(turned(kPlayShare * inside));
  }
  return poses;
}

// Checks that certificates about the named features suffice. The parts must meet nowhere else,
// neither on the way in nor at the seat, wherever the held part is within the play of these
// features.
void MatingFile::CheckNothingElseFits(const Value& features, const Mating& mating) const {
  const auto& held = problem_.part(mating.held).model->shape();
  const auto& fixed = problem_.part(mating.fixed).model->shape();
  double depth = 0;
  for (const ShaftFit& fit : FitsOf(problem_, mating)) depth = std::max(depth, fit.depth);
  for (const Pose& X_FixedHeld : PosesWithinPlay(problem_, mating)) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Vector3 back = -share * depth * mating.mating_vector.normalized();
      if (!Overlaps(held, geometry::Translation(back) * X_FixedHeld, fixed, Pose::Identity(),
                    kBesideWall)) {
        continue;
      }
      features.Fail("within the play of these features, other surfaces of the parts touch",
                    "all shafts and holes that meet in the mating");
    }
  }
}

}  // namespace

void RequireShaftInHole(const Value& value, const Problem& problem, MatingId id) {
  const Mating& mating = problem.mating(id);
  if (HasShaftInHole(problem, mating)) return;
  value.At("features")
      .Fail(fmt::format("the planner cannot prove this kind of mating of {} with {}",
                        problem.part(mating.held).name, problem.part(mating.fixed).name),
            "at least one shaft in a hole whose walls face each other in two or more directions");
}

MatingId AddMating(const Value& value, const Units& units, Problem& problem) {
  Mating mating = MatingFile(problem, units).Read(value);
  const auto known = std::ranges::find_if(
      problem.matings, [&](const Mating& other) { return IsSameMating(mating, other); });
  const MatingId id(static_cast<std::size_t>(known - problem.matings.begin()));
  if (known == problem.matings.end()) problem.matings.push_back(std::move(mating));
  return id;
}

}  // namespace assay::domain
