#include "planner/domain/parts/solids/part_solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/parts/solids/bevels.h"
#include "planner/domain/parts/solids/solid_shapes.h"
#include "planner/domain/problem/name.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/connected_solids.h"
#include "planner/geometry/solids/convex_cut.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {
namespace {

using geometry::ConvexHull;
using geometry::Pose;
using geometry::Vector3;

constexpr double kThinnestWall = 1e-5;  // least wall that a pocket may leave, metres
constexpr double kLeastCut = 1e-12;     // least volume of a pocket, cubic metres
constexpr Range kChamfers = {0, 0.02};  // metres

Eigen::Vector4f ReadColor(const Value& value) {
  const std::vector<double> numbers = value.Numbers(4);
  Eigen::Vector4f color;
  for (int i = 0; i < 4; ++i) {
    const double number = numbers[static_cast<std::size_t>(i)];
    if (number < 0 || number > 1) {
      value.Fail(fmt::format("{} is no part of a color", number),
                 "red, green, blue, alpha in 0..1");
    }
    color[i] = static_cast<float>(number);
  }
  return color;
}

Widening ReadWidening(const Value& entry, double clearance) {
  Widening widening{.by = clearance};
  const auto widen = entry.Find("widen");
  if (!widen) return widening;
  if (!widen->IsList()) {
    widen->OneOf({"across"});
    widening.across = true;
    return widening;
  }
  for (const Value& axis : widen->Items()) {
    widening.along[static_cast<std::size_t>(axis.OneOf({"x", "y", "z"}))] = true;
  }
  return widening;
}

// Fails at the first key of the entry that is neither one of `keys` nor the kind of a shape.
void AllowShapeAnd(const Value& entry, std::vector<std::string> keys) {
  std::ranges::copy(ShapeKinds(), std::back_inserter(keys));
  entry.AllowOnly(keys);
}

template <class Named>
std::vector<std::string> NamesOf(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

// Returns the elements with one name or a list of names. `what` says what they are: "solid".
template <class Named>
std::vector<const Named*> OneOrMore(const Value& names, const std::vector<Named>& all,
                                    const char* what) {
  const std::vector<std::string> known = NamesOf(all);
  const auto find = [&](const Value& name) {
    return &all[static_cast<std::size_t>(name.OneOf(known))];
  };
  if (!names.IsList()) return {find(names)};
  std::vector<const Named*> found;
  for (const Value& name : names.Items()) found.push_back(find(name));
  if (found.empty()) names.Fail("the list is empty", fmt::format("at least one {}", what));
  return found;
}

double VolumeOf(std::span<const ConvexHull> solids) {
  double volume = 0;
  for (const ConvexHull& solid : solids) volume += geometry::Volume(solid);
  return volume;
}

// Returns whether a piece is a wall that is too thin: both of its broad sides are exposed. A thin
// piece between other pieces is only a seam of the cuts.
bool IsThinWall(const ConvexHull& piece, std::span<const ConvexHull> pieces) {
  if (geometry::ThicknessOf(piece) >= kThinnestWall) return false;
  constexpr double kOpposite = -0.9;  // cosine
  const std::vector<Side> sides = SidesOf(piece);
  return std::ranges::any_of(sides, [&](const Side& side) {
    return IsExposed(side, pieces) && std::ranges::any_of(sides, [&](const Side& other) {
             return other.normal.dot(side.normal) < kOpposite && IsExposed(other, pieces);
           });
  });
}

// Returns the pieces of a solid without those of a pocket. All are in the part frame.
std::vector<ConvexHull> Without(const std::vector<ConvexHull>& pieces,
                                std::span<const ConvexHull> pocket) {
  std::vector<ConvexHull> rest = pieces;
  for (const ConvexHull& of_pocket : pocket) {
    std::vector<ConvexHull> remaining;
    for (const ConvexHull& piece : rest) {
      std::ranges::move(geometry::Without(piece, of_pocket), std::back_inserter(remaining));
    }
    rest = std::move(remaining);
  }
  return rest;
}

// Fails if a pocket or a chamfer, named by `what`, leaves nothing of a solid, or a thin wall.
void CheckRest(const std::vector<ConvexHull>& rest, const char* what, const Value& place) {
  if (rest.empty()) place.Fail(fmt::format("the {} leaves nothing of its solid", what));
  for (const ConvexHull& piece : rest) {
    if (!IsThinWall(piece, rest)) continue;
    place.Fail(fmt::format("the {} leaves a wall that is too thin", what),
               fmt::format("walls of at least {} m, or none", kThinnestWall));
  }
}

// Returns what is below all of the planes, or none if nothing remains.
std::optional<ConvexHull> Below(const ConvexHull& solid, std::span<const geometry::Plane> planes) {
  std::optional<ConvexHull> rest = solid;
  for (const geometry::Plane& plane : planes) {
    if (rest) rest = geometry::Below(*rest, plane);
  }
  return rest;
}

// Returns whether a convex piece is part of a convex solid. Otherwise it lies beside the solid.
bool IsPartOf(const ConvexHull& piece, const ConvexHull& solid) {
  return Contains(solid, geometry::BallAround(piece.vertices).center, 0);
}

// Returns whether a feature is a hole that has a pocket of this name.
bool IsHoleWith(const Value& feature, const std::string& pocket) {
  const auto hole = feature.Find("hole");
  if (!hole) return false;
  const std::vector<Value> names = hole->IsList() ? hole->Items() : std::vector{*hole};
  return std::ranges::any_of(
      names, [&](const Value& name) { return name.IsScalar() && name.Text() == pocket; });
}

}  // namespace

PartSolids::PartSolids(const Value& root, const Units& units, double clearance)
    : units_(units), clearance_(clearance) {
  ReadSolids(root.At("solids"));
  std::vector<Value> chamfered;
  if (const auto features = root.Find("features")) {
    for (const auto& [key, entry] : features->Entries()) {
      if (entry.Find("chamfer")) chamfered.push_back(entry);
    }
  }
  if (const auto pockets = root.Find("pockets")) ReadPockets(*pockets, chamfered);
  ReadTips(chamfered);
}

void PartSolids::ReadSolids(const Value& solids) {
  for (const auto& [key, entry] : solids.Entries()) {
    solids_.push_back(ReadSolid(ReadAnyName(key), entry));
  }
  if (solids_.empty()) solids.Fail("a part needs at least one solid");
}

PartSolids::Solid PartSolids::ReadSolid(const std::string& name, const Value& entry) const {
  AllowShapeAnd(entry, {"color", "turn"});
  Solid solid{.name = name,
              .X_PartSolid = Pose::Identity(),
              .whole = {},
              .pieces = {},
              .round = {},
              .color = Eigen::Vector4f(0.7f, 0.7f, 0.7f, 1)};
  if (const auto turn = entry.Find("turn")) solid.X_PartSolid = ReadTurn(*turn);
  if (const auto color = entry.Find("color")) solid.color = ReadColor(*color);
  const SolidShape shape = ReadShape(entry, units_, Roundness::kAround, {});
  solid.whole = Transformed(shape.pieces, solid.X_PartSolid);
  solid.pieces = solid.whole;
  if (shape.round) solid.round = Transformed(*shape.round, solid.X_PartSolid);
  return solid;
}

Pose PartSolids::ReadTurn(const Value& turn) const {
  turn.AllowOnly({"axis", "angle", "about"});
  const Vector3 axis = ReadDirection(turn.At("axis"));
  const Pose turned(Eigen::AngleAxisd(ReadAngle(turn.At("angle"), units_), axis));
  const auto about = turn.Find("about");
  if (!about) return turned;
  const Vector3 center = ReadVector3(*about, units_);
  return geometry::Translation(center) * turned * geometry::Translation(-center);
}

void PartSolids::ReadPockets(const Value& pockets, const std::vector<Value>& chamfered) {
  for (const auto& [key, entry] : pockets.Entries()) {
    const Pocket& pocket = pockets_.emplace_back(ReadPocket(ReadAnyName(key), entry));
    Solid& solid = solids_[static_cast<std::size_t>(pocket.solid)];
    std::vector<ConvexHull> bevelled;
    std::vector<ConvexHull> rest = solid.pieces;
    for (const Value& feature : chamfered) CutMouth(feature, pocket, rest, bevelled);
    rest = Without(rest, pocket.whole);
    std::ranges::move(bevelled, std::back_inserter(rest));
    if (VolumeOf(solid.pieces) - VolumeOf(rest) < kLeastCut) {
      entry.Fail("the pocket cuts nothing from its solid", "a shape that overlaps the solid");
    }
    CheckRest(rest, "pocket", entry);
    solid.pieces = std::move(rest);
  }
}

PartSolids::Pocket PartSolids::ReadPocket(const std::string& name, const Value& entry) const {
  AllowShapeAnd(entry, {"cut_from", "widen"});
  const int from = entry.At("cut_from").OneOf(NamesOf(solids_));
  const Pose& X_PartSolid = solids_[static_cast<std::size_t>(from)].X_PartSolid;
  SolidShape shape = ReadShape(entry, units_, Roundness::kWithin, ReadWidening(entry, clearance_));
  for (geometry::Vector3& normal : shape.moved_sides) normal = X_PartSolid.linear() * normal;
  return {.name = name,
          .solid = from,
          .whole = Transformed(shape.pieces, X_PartSolid),
          .moved_sides = std::move(shape.moved_sides)};
}

void PartSolids::ReadTips(const std::vector<Value>& chamfered) {
  for (const Value& feature : chamfered) {
    const auto shaft = feature.Find("shaft");
    if (!shaft) continue;
    const Value chamfer = feature.At("chamfer");
    const double size = ReadWithin(chamfer, units_.length, kChamfers);
    if (size > 0) BevelTip(SolidsNamed(*shaft), ReadDirection(feature.At("axis")), size, chamfer);
  }
}

void PartSolids::BevelTip(const std::vector<const Solid*>& shaft, const Vector3& axis, double size,
                          const Value& place) {
  std::vector<ConvexHull> all;
  for (const Solid& solid : solids_) std::ranges::copy(solid.whole, std::back_inserter(all));
  double tip = -std::numeric_limits<double>::infinity();
  for (const Solid* const of_shaft : shaft)
    tip = std::max(tip, FarthestAlong(of_shaft->whole, axis));
  for (const Solid* const of_shaft : shaft) {
    Solid& solid = solids_[static_cast<std::size_t>(of_shaft - solids_.data())];
    for (ConvexHull& whole : solid.whole) {
      const std::vector<geometry::Plane> bevels = BevelsAtEnd(whole, all, axis, tip, size);
      if (bevels.empty()) continue;
      std::optional<ConvexHull> bevelled = Below(whole, bevels);
      if (!bevelled || GreatestAlong(*bevelled, axis) < tip - kRounding ||
          -GreatestAlong(whole, -axis) > tip - size) {
        place.Fail(fmt::format("a chamfer of {} leaves nothing of the tip, or of a side",
                               InUnit(size, units_.length)),
                   "less than half the width of the tip, and less than the length of the shaft");
      }
      std::vector<ConvexHull> pieces;
      for (const ConvexHull& piece : solid.pieces) {
        std::optional<ConvexHull> rest = IsPartOf(piece, whole) ? Below(piece, bevels) : piece;
        if (rest) pieces.push_back(*std::move(rest));
      }
      CheckRest(pieces, "chamfer", place);
      solid.pieces = std::move(pieces);
      whole = *std::move(bevelled);
    }
  }
}

void PartSolids::CutMouth(const Value& feature, const Pocket& pocket, std::vector<ConvexHull>& rest,
                          std::vector<ConvexHull>& bevelled) const {
  if (!IsHoleWith(feature, pocket.name)) return;
  const Value chamfer = feature.At("chamfer");
  const double size = ReadWithin(chamfer, units_.length, kChamfers);
  if (size <= 0) return;
  const Vector3 axis = ReadDirection(feature.At("axis"));
  const std::vector<ConvexHull> hollow = Clipped(pocket);
  const double mouth = FarthestAlong(hollow, axis);
  const double depth = mouth + FarthestAlong(hollow, -axis);
  if (size >= depth) {
    chamfer.Fail(fmt::format("a chamfer of {} leaves nothing of the hole's walls",
                             InUnit(size, units_.length)),
                 fmt::format("less than the depth of {}", InUnit(depth, units_.length)));
  }
  std::vector<ConvexHull> above;
  std::vector<ConvexHull> below;
  for (const ConvexHull& piece : rest) {
    if (auto upper = geometry::Below(piece, {-axis, size - mouth})) above.push_back(*upper);
    if (auto lower = geometry::Below(piece, {axis, mouth - size})) below.push_back(*lower);
  }
  std::ranges::move(Without(above, BevelledMouth(hollow, axis, mouth, size)),
                    std::back_inserter(bevelled));
  rest = std::move(below);
}

std::vector<ConvexHull> PartSolids::Pieces() const {
  std::vector<ConvexHull> pieces;
  for (const Solid& solid : solids_) {
    pieces.insert(pieces.end(), solid.pieces.begin(), solid.pieces.end());
  }
  return pieces;
}

std::vector<geometry::RoundSolid> PartSolids::RoundSolids() const {
  std::vector<geometry::RoundSolid> round;
  for (const Solid& solid : solids_) {
    if (solid.round) round.push_back(*solid.round);
  }
  return round;
}

void PartSolids::CheckHangsTogether(const Value& solids) const {
  int apart = geometry::FirstApart(Pieces());
  if (apart < 0) return;
  auto solid = solids_.begin();
  while (apart >= std::ssize(solid->pieces)) {
    apart -= static_cast<int>(solid->pieces.size());
    ++solid;
  }
  const Value place = solids.At(solid->name);
  if (geometry::FirstApart(solid->pieces) >= 0) {
    place.Fail(fmt::format("the pockets cut solid '{}' into unconnected pieces", solid->name),
               "a solid in one piece");
  }
  place.Fail(
      fmt::format("solid '{}' is not connected to solid '{}', directly or through other solids",
                  solid->name, solids_.front().name),
      "solids that overlap, or touch in a face");
}

const PartSolids::Solid& PartSolids::SolidNamed(const Value& name) const {
  return solids_[static_cast<std::size_t>(name.OneOf(NamesOf(solids_)))];
}

const PartSolids::Solid& PartSolids::SolidOf(const Pocket& pocket) const {
  return solids_[static_cast<std::size_t>(pocket.solid)];
}

std::vector<ConvexHull> PartSolids::Clipped(const Pocket& pocket) const {
  std::vector<ConvexHull> clipped;
  for (const ConvexHull& of_solid : SolidOf(pocket).whole) {
    for (const ConvexHull& of_pocket : pocket.whole) {
      if (auto common = Intersection(of_pocket, of_solid)) clipped.push_back(*std::move(common));
    }
  }
  return clipped;
}

std::vector<const PartSolids::Solid*> PartSolids::SolidsNamed(const Value& names) const {
  return OneOrMore(names, solids_, "solid");
}

std::vector<const PartSolids::Pocket*> PartSolids::PocketsNamed(const Value& names) const {
  return OneOrMore(names, pockets_, "pocket");
}

}  // namespace assay::domain
