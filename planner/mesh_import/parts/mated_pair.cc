#include "planner/mesh_import/parts/mated_pair.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace assay::mesh_import {
namespace {

constexpr double kOpposite = 1e-4;           // radians
constexpr double kTightest = -1e-5;          // metres: a gap that counts as rounding
constexpr double kWidestPlay = 0.35;         // share of the width of the hole
constexpr double kSameOutline = 1e-6;        // metres, between outlines that count as equal
constexpr double kMostBeside = 0.9e-3;       // metres between axes, as a scenario permits
constexpr double kGreatestNarrowing = 0.25;  // share of a gap that polygons may take
constexpr int kMostSidesOfCircle = 128;      // more make a hole's collision slow

// A feature with its post, in the frame of the files.
struct PlacedFeature {
  int number = 0;
  const Post* post = nullptr;
  Matrix3 R_FileLocal;
  Vector3 axis;

  // Returns a point of the section of another post in the section of this one.
  Vector2 InSection(const PlacedFeature& other, const Vector2& p) const {
    const Vector3 in_file = other.R_FileLocal * Vector3(p.x(), p.y(), other.post->low);
    return (R_FileLocal.transpose() * in_file).head<2>();
  }
};

// A shaft and a hole that meet.
struct Meeting {
  PlacedFeature shaft;
  PlacedFeature hole;
  MatedFeatures mated;
  double reach = 0;        // of the held part below the mouth, metres
  bool is_inside = false;  // or else the shaft has passed the hole
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
  const auto in_hole = [&](const Vector2& p) { return hole.InSection(shaft, p); };
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

// Returns how far solids of a part reach along the axis of a shaft, if they are in line with it.
double ReachOf(const PartSketch& sketch, const PlacedFeature& shaft) {
  constexpr int kSides = 32;
  double reach = EndAlong(shaft);
  for (const SketchSolid& solid : sketch.solids) {
    for (const Vector3& corner : solid.Corners(kSides)) {
      const Vector3 in_file = sketch.R_FilePart * corner;
      const Vector3 p = shaft.R_FileLocal.transpose() * in_file;
      if (shaft.post->at_low.Contains(p.head<2>()))
        reach = std::max(reach, shaft.axis.dot(in_file));
    }
  }
  return reach;
}

std::optional<Meeting> Meet(const PlacedFeature& shaft, const PlacedFeature& hole) {
  if ((shaft.axis + hole.axis).norm() > kOpposite) return std::nullopt;
  const double depth = EndAlong(hole) + EndAlong(shaft);  // the axes are opposite
  if (depth <= 0) return std::nullopt;
  MatedFeatures mated{.shaft = shaft.number,
                      .hole = hole.number,
                      .mouth = hole.axis,
                      .depth = depth,
                      .gaps = GapsBetween(shaft, hole)};
  const double width = hole.post->at_low.Bounds().sizes().minCoeff();
  if (mated.LeastGap() < kTightest || mated.LeastGap() > kWidestPlay * width) return std::nullopt;
  return Meeting{.shaft = shaft,
                 .hole = hole,
                 .mated = std::move(mated),
                 .is_inside = depth - shaft.post->Height() < hole.post->Height()};
}

bool IsWithin(const PlacedFeature& inner, const PlacedFeature& outer) {
  constexpr int kSides = 64;
  const Contour& around = outer.post->at_low;
  return std::ranges::all_of(inner.post->at_low.Outline(kSides), [&](const Vector2& corner) {
    const Vector2 p = outer.InSection(inner, corner);
    return around.Contains(p) || around.DistanceTo(p) <= kSameOutline;
  });
}

// Returns whether what holds of one meeting holds of another one, too: the hole is the same, and a
// shaft as wide as this one goes before it, or the shaft is the same, and it has come through a
// hole as narrow as this one.
bool Implies(const Meeting& first, const Meeting& later) {
  const bool has_same_hole = first.mated.hole == later.mated.hole;
  const bool has_same_shaft = first.mated.shaft == later.mated.shaft;
  if (has_same_hole == has_same_shaft || first.mated.depth <= later.mated.depth ||
      (later.is_inside && !first.is_inside))
    return false;
  return has_same_hole ? IsWithin(later.shaft, first.shaft) : IsWithin(first.hole, later.hole);
}

// Returns how far the axes of a shaft and its hole are apart.
double BesideOf(const Meeting& meeting) {
  const Vector2 axis = meeting.hole.InSection(meeting.shaft, meeting.shaft.post->at_low.center);
  return (axis - meeting.hole.post->at_low.center).norm();
}

// Returns the meetings of two parts: those of shafts that are in their holes first, then those in
// straight holes, which have walls along the motion, then the tightest, then those for which the
// held part moves least.
std::vector<Meeting> MeetingsOf(const PartSketch& held, const PartSketch& fixed) {
  std::vector<Meeting> meetings;
  const auto holes = PlacedFeatures(fixed, SketchFeature::Kind::kHole);
  for (const PlacedFeature& shaft : PlacedFeatures(held, SketchFeature::Kind::kShaft)) {
    for (const PlacedFeature& hole : holes) {
      std::optional<Meeting> meeting = Meet(shaft, hole);
      if (!meeting) continue;
      meeting->reach = EndAlong(hole) + ReachOf(held, shaft);
      meetings.push_back(*std::move(meeting));
    }
  }
  std::ranges::stable_sort(meetings, {}, [](const Meeting& meeting) {
    return std::tuple(!meeting.is_inside, !meeting.hole.post->is_straight, meeting.mated.LeastGap(),
                      meeting.reach, meeting.mated.depth);
  });
  if (!meetings.empty() && !meetings.front().is_inside) meetings.clear();
  return meetings;
}

// Leaves those meetings that the motion of the first one brings about, without those that follow
// from others.
void LeaveOneMotion(std::vector<Meeting>& meetings) {
  const std::vector<Meeting> all = meetings;
  std::erase_if(meetings, [&](const Meeting& meeting) {
    const auto implies = [&](const Meeting& other) { return Implies(other, meeting); };
    return (meeting.mated.mouth - all.front().mated.mouth).norm() > kOpposite ||
           std::ranges::any_of(all, implies);
  });
  const auto is_needless = [](const Meeting& meeting) {
    return BesideOf(meeting) > kMostBeside || !meeting.hole.post->is_straight;
  };
  const auto others = std::ranges::remove_if(meetings.begin() + 1, meetings.end(), is_needless);
  meetings.erase(others.begin(), others.end());
}

MatedPair PairOf(const ImportedPart& held, const ImportedPart& fixed) {
  MatedPair pair{.held = &held, .fixed = &fixed, .features = {}};
  std::vector<Meeting> meetings = MeetingsOf(held.sketch, fixed.sketch);
  if (meetings.empty()) return pair;
  LeaveOneMotion(meetings);
  for (const Meeting& meeting : meetings) {
    pair.features.push_back(meeting.mated);
    pair.reach = std::max(pair.reach, meeting.reach);
  }
  return pair;
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
