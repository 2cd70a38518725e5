#include "planner/mesh_import/parts/mated_pair.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "planner/mesh_import/parts/resting_pose.h"

namespace assay::mesh_import {
namespace {

constexpr double kOpposite = 1e-4;        // radians
constexpr double kTightest = -1e-5;       // metres: a gap that counts as rounding
constexpr double kWidestPlay = 0.35;      // share of the width of the hole
constexpr double kBeforeMouth = 0.02;     // metres that the mating motion begins before the mouth
constexpr double kLeastClearance = 1e-6;  // metres, as a scenario file permits
constexpr double kClampForce = 300;       // newtons
constexpr double kGreatestNarrowing = 0.25;  // share of a gap that polygons may take
constexpr int kMostSidesOfCircle = 128;      // more make a hole's collision slow
// The gripper for small parts takes parts of this width, if they are no longer, in metres.
constexpr double kSmallWidth = 0.03;
constexpr double kSmallLength = 0.1;
const Vector2 kFixedPlace(0.6, 0.05);  // on the table, metres
const Vector2 kHeldPlace(0.5, -0.2);

// A feature with its post, in the frame of the files.
struct PlacedFeature {
  int number = 0;
  const Post* post = nullptr;
  Matrix3 R_FileLocal;
  Vector3 axis;
};

const SketchFeature& FeatureOf(const ImportedPart& part, int number) {
  return part.sketch.features[static_cast<std::size_t>(number - 1)];
}

std::vector<PlacedFeature> PlacedFeatures(const PartSketch& sketch, SketchFeature::Kind kind) {
  std::vector<PlacedFeature> placed;
  for (std::size_t i = 0; i < sketch.features.size(); ++i) {
    const SketchFeature& feature = sketch.features[i];
    if (feature.kind != kind) continue;
    const auto add = [&](const SketchSolid& solid, const Post& post) {
      placed.push_back({.number = static_cast<int>(i) + 1,
                        .post = &post,
                        .R_FileLocal = sketch.R_FilePart * solid.R_PartLocal,
                        .axis = sketch.R_FilePart * feature.direction});
    };
    for (const SketchSolid& solid : sketch.solids) {
      if (solid.name == feature.of && solid.post) add(solid, *solid.post);
    }
    for (const SketchPocket& pocket : sketch.pockets) {
      if (pocket.name == feature.of)
        add(sketch.solids[static_cast<std::size_t>(pocket.solid)], pocket.pocket.post);
    }
  }
  return placed;
}

// Returns the height of the end of a post to which its feature's axis points, along this axis.
double EndAlong(const PlacedFeature& feature) {
  const double sign = feature.axis.dot(feature.R_FileLocal.col(2)) > 0 ? 1 : -1;
  return sign > 0 ? feature.post->high : -feature.post->low;
}

// Returns the gaps between a shaft and the sides of a hole, in the section of the hole.
std::vector<double> GapsBetween(const PlacedFeature& shaft, const PlacedFeature& hole) {
  constexpr int kSides = 128;
  const Contour& around = hole.post->at_low;
  const Contour& outline = shaft.post->at_low;
  const auto in_hole = [&](const Vector2& p) -> Vector2 {
    const Vector3 in_file = shaft.R_FileLocal * Vector3(p.x(), p.y(), shaft.post->low);
    return (hole.R_FileLocal.transpose() * in_file).head<2>();
  };
  if (around.IsCircle() && outline.IsCircle()) {
    const double off = (in_hole(outline.center) - around.center).norm();
    return {around.radius - outline.radius - off, around.radius - outline.radius + off};
  }
  std::vector<Vector2> points;
  for (const Vector2& corner : outline.Outline(kSides)) points.push_back(in_hole(corner));
  if (around.IsCircle()) {
    std::vector<double> gaps;
    for (const Vector2& p : points) gaps.push_back(around.radius - (p - around.center).norm());
    return {std::ranges::min(gaps), std::ranges::max(gaps)};
  }
  std::vector<double> gaps;
  for (std::size_t i = 0; i < around.corners.size(); ++i) {
    const Vector2& a = around.corners[i];
    const Vector2 along = (around.corners[(i + 1) % around.corners.size()] - a).normalized();
    const Vector2 inward(-along.y(), along.x());
    double gap = std::numeric_limits<double>::infinity();
    for (const Vector2& p : points) gap = std::min(gap, inward.dot(p - a));
    gaps.push_back(gap);
  }
  return gaps;
}

std::optional<MatedFeatures> Mate(const PlacedFeature& shaft, const PlacedFeature& hole) {
  if ((shaft.axis + hole.axis).norm() > kOpposite) return std::nullopt;
  const double depth = EndAlong(hole) + EndAlong(shaft);  // the axes are opposite
  if (depth <= 0 || depth - shaft.post->Height() >= hole.post->Height()) return std::nullopt;
  MatedFeatures mated{.shaft = shaft.number,
                      .hole = hole.number,
                      .mouth = hole.axis,
                      .depth = depth,
                      .gaps = GapsBetween(shaft, hole)};
  const double width = hole.post->at_low.Bounds().sizes().minCoeff();
  if (mated.LeastGap() < kTightest || mated.LeastGap() > kWidestPlay * width) return std::nullopt;
  return mated;
}

MatedPair PairOf(const ImportedPart& held, const ImportedPart& fixed) {
  MatedPair pair{.held = &held, .fixed = &fixed, .features = {}};
  const auto holes = PlacedFeatures(fixed.sketch, SketchFeature::Kind::kHole);
  for (const PlacedFeature& shaft : PlacedFeatures(held.sketch, SketchFeature::Kind::kShaft)) {
    for (const PlacedFeature& hole : holes) {
      if (const std::optional<MatedFeatures> mated = Mate(shaft, hole))
        pair.features.push_back(*mated);
    }
  }
  std::ranges::stable_sort(pair.features, {}, [](const MatedFeatures& mated) {
    return std::pair(mated.LeastGap(), mated.depth);
  });
  // A shaft that goes through its hole has a tip on either side.
  const auto is_the_same = [&](const MatedFeatures& a, const MatedFeatures& b) {
    return FeatureOf(fixed, a.hole).of == FeatureOf(fixed, b.hole).of &&
           a.LeastGap() == b.LeastGap();
  };
  const auto repeated = std::ranges::unique(pair.features, is_the_same);
  pair.features.erase(repeated.begin(), repeated.end());
  return pair;
}

// `places` is the number of decimal places.
std::string NumbersText(const Vector3& v, double unit, int places = 6) {
  const auto number = [&](double value) {
    const double scale = std::pow(10, places);
    return fmt::format("{:.{}g}", std::round(value / unit * scale) / scale + 0.0, places);
  };
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}

std::string PoseText(const Matrix3& R, const Vector3& position) {
  constexpr int kPlaces = 9;  // axes are to be orthonormal to 1e-6
  return fmt::format("{{columns: [{}, {}, {}, {}]}}", NumbersText(R.col(0), 1, kPlaces),
                     NumbersText(R.col(1), 1, kPlaces), NumbersText(R.col(2), 1, kPlaces),
                     NumbersText(position, 1e-3));
}

std::string PartLine(const ImportedPart& part, const Vector3& down, const Vector2& at,
                     const std::string& more) {
  const geometry::Pose X_WorldPart = OnTable(part, down, at);
  return fmt::format("  {0}:\n    model: {0}\n    pose: {1}\n{2}", part.sketch.name,
                     PoseText(X_WorldPart.linear(), X_WorldPart.translation()), more);
}

// Returns the workcell whose gripper suits a part.
std::string WorkcellFor(const ImportedPart& held) {
  const Vector3 extents = ExtentsOf(held);
  const bool is_small = extents.minCoeff() <= kSmallWidth && extents.maxCoeff() <= kSmallLength;
  return is_small ? "puma762-small-jaw" : "puma762-table";
}

// Returns that direction of a part which points down on the table if the part rests as nearly as
// it can with another direction down.
Vector3 DownOf(const ImportedPart& part, const Vector3& wanted) {
  const std::vector<RestingPose> poses = RestingPosesOf(part);
  if (poses.empty()) return -Vector3::UnitZ();
  return std::ranges::max_element(poses, {},
                                  [&](const RestingPose& pose) { return pose.down.dot(wanted); })
      ->down;
}

// Returns the radii of a round shaft and its hole; 0 for other shapes.
std::pair<double, double> RadiiOf(const MatedPair& pair, const MatedFeatures& mated) {
  const auto radius_of = [](const ImportedPart& part, int number, SketchFeature::Kind kind) {
    for (const PlacedFeature& feature : PlacedFeatures(part.sketch, kind)) {
      if (feature.number == number) return feature.post->at_low.radius;
    }
    return 0.0;
  };
  return {radius_of(*pair.held, mated.shaft, SketchFeature::Kind::kShaft),
          radius_of(*pair.fixed, mated.hole, SketchFeature::Kind::kHole)};
}

// Returns by how much polygons narrow the gap between a round shaft and its hole, in metres.
double NarrowingOf(const MatedPair& pair, const MatedFeatures& mated, int sides) {
  const auto [shaft, hole] = RadiiOf(pair, mated);
  const double half = std::numbers::pi / sides;
  return shaft * (1 / std::cos(half) - 1) + hole * (1 - std::cos(half));
}

bool IsRound(const MatedFeatures& mated) { return mated.gaps.size() == 2; }

// Returns a sentence about the gap that remains because polygons stand for circles.
std::string PolygonSentence(const MatedPair& pair, const MatedFeatures& mated) {
  const int sides = pair.held->options.sides;
  return fmt::format(" As polygons with {} sides the parts leave {} mm; --sides sets the number.",
                     sides, Millimetres(mated.LeastGap() - NarrowingOf(pair, mated, sides)));
}

}  // namespace

double MatedFeatures::LeastGap() const { return std::ranges::min(gaps); }

geometry::Pose MatedPair::X_FixedHeld() const {
  geometry::Pose X = geometry::Pose::Identity();
  X.linear() = fixed->sketch.R_FilePart.transpose() * held->sketch.R_FilePart;
  return X;
}

Vector3 MatedPair::MatingDirection() const {
  return -(fixed->sketch.R_FilePart.transpose() * features.front().mouth);
}

std::optional<MatedPair> FindMating(const ImportedPart& a, const ImportedPart& b) {
  MatedPair pair = PairOf(a, b);
  if (pair.features.empty()) pair = PairOf(b, a);
  if (pair.features.empty()) return std::nullopt;
  return pair;
}

int SidesFor(const MatedPair& pair) {
  int sides = pair.held->options.sides;
  for (const MatedFeatures& mated : pair.features) {
    const double most = kGreatestNarrowing * mated.LeastGap();
    while (IsRound(mated) && sides < kMostSidesOfCircle && NarrowingOf(pair, mated, sides) > most)
      sides += 4;
  }
  return sides;
}

std::string ScenarioText(const MatedPair& pair) {
  const ImportedPart& held = *pair.held;
  const ImportedPart& fixed = *pair.fixed;
  const MatedFeatures& mated = pair.features.front();
  const Vector3 down = pair.MatingDirection();
  const Matrix3 R_FixedHeld = pair.X_FixedHeld().linear();
  std::string text = fmt::format(
      "format: assay-scenario/1\ntitle: {0} into {1}\nunits: {{length: mm, angle: degree}}\n"
      "workcell: {2}\nclearance: {3}  # as in the files: no hole is widened\nparts:\n",
      held.sketch.name, fixed.sketch.name, WorkcellFor(held),
      Millimetres(std::max(mated.LeastGap(), kLeastClearance)));
  text += PartLine(fixed, DownOf(fixed, down), kFixedPlace,
                   fmt::format("    clamp: {:.0f}  # newtons of a fixture\n", kClampForce));
  text += PartLine(held, DownOf(held, R_FixedHeld.transpose() * down), kHeldPlace, "");
  text += fmt::format(
      "goal:\n  - assembled:\n      held: {}\n      fixed: {}\n      features: [[{}], [{}]]\n"
      "      pose: {}\n      mating_vector: {}\n",
      held.sketch.name, fixed.sketch.name, mated.shaft, mated.hole,
      PoseText(R_FixedHeld, pair.way_to_seat * down),
      NumbersText((mated.depth + pair.way_to_seat + kBeforeMouth) * down, 1e-3));
  return text;
}

std::vector<std::string> AccountOf(const MatedPair& pair) {
  std::vector<std::string> account;
  for (const MatedFeatures& mated : pair.features) {
    std::vector<std::string> gaps;
    for (const double gap : mated.gaps) gaps.push_back(Millimetres(gap));
    account.push_back(fmt::format(
        "Feature {} of {} ({}) is {} mm deep in feature {} of {} ({}). The gaps {} are {} mm.",
        mated.shaft, pair.held->sketch.name, FeatureOf(*pair.held, mated.shaft).what,
        Millimetres(mated.depth), mated.hole, pair.fixed->sketch.name,
        FeatureOf(*pair.fixed, mated.hole).what,
        IsRound(mated) ? "on the narrowest and the widest side" : "on the sides of the hole",
        fmt::join(gaps, ", ")));
    if (IsRound(mated)) account.back() += PolygonSentence(pair, mated);
  }
  if (pair.way_to_seat != 0) {
    account.push_back(fmt::format(
        "In the files, {0} does not end at a seat. The scenario moves it {1} by {2} mm, to where "
        "{3} or the table under {3} stops it.",
        pair.held->sketch.name, pair.way_to_seat > 0 ? "on" : "back",
        Millimetres(std::abs(pair.way_to_seat)), pair.fixed->sketch.name));
  }
  return account;
}

}  // namespace assay::mesh_import
