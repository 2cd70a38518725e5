#include "planner/domain/parts/part_solids.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/domain/problem/name.h"
#include "planner/geometry/connected_boxes.h"

namespace assay::domain {
namespace {

using geometry::Box;
using geometry::Pose;
using geometry::Vector3;

constexpr double kShortestSide = 1e-4;  // least side of a box in the file, metres
constexpr double kThinnestWall = 1e-5;  // least wall that a pocket may leave, metres
constexpr double kLeastCut = 1e-12;     // least volume of a pocket, cubic metres

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

std::array<bool, 3> ReadWidening(const Value& axes) {
  std::array<bool, 3> is_widened = {};
  for (const Value& axis : axes.Items()) {
    is_widened[static_cast<std::size_t>(axis.OneOf({"x", "y", "z"}))] = true;
  }
  return is_widened;
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

double Volume(const std::vector<Box>& boxes) {
  double volume = 0;
  for (const Box& box : boxes) volume += box.Volume();
  return volume;
}

// Returns the solid's pieces without a pocket. Both are in the part frame.
std::vector<Box> Cut(const std::vector<Box>& pieces, const Box& pocket, const Value& place) {
  std::vector<Box> rest;
  for (const Box& piece : pieces) {
    for (const Box& box : Subtract(piece, pocket)) rest.push_back(box);
  }
  if (rest.empty()) place.Fail("the pocket leaves nothing of its solid");
  if (Volume(pieces) - Volume(rest) < kLeastCut) {
    place.Fail("the pocket cuts nothing from its solid", "a box that overlaps the solid");
  }
  for (const Box& box : rest) {
    if (2 * box.half_extents.minCoeff() >= kThinnestWall) continue;
    place.Fail("the pocket leaves a wall that is too thin",
               fmt::format("walls of at least {} m, or none", kThinnestWall));
  }
  return rest;
}

}  // namespace

PartSolids::PartSolids(const Value& root, const Units& units, double clearance)
    : units_(units), clearance_(clearance) {
  ReadSolids(root.At("solids"));
  if (const auto pockets = root.Find("pockets")) ReadPockets(*pockets);
}

void PartSolids::ReadSolids(const Value& solids) {
  for (const auto& [key, entry] : solids.Entries()) {
    solids_.push_back(ReadSolid(ReadAnyName(key), entry));
  }
  if (solids_.empty()) solids.Fail("a part needs at least one solid");
}

PartSolids::Solid PartSolids::ReadSolid(const std::string& name, const Value& entry) const {
  entry.AllowOnly({"box", "color", "turn"});
  Solid solid{.name = name,
              .X_PartSolid = Pose::Identity(),
              .whole = ReadBox(entry.At("box")),
              .pieces = {},
              .color = Eigen::Vector4f(0.7f, 0.7f, 0.7f, 1)};
  if (const auto turn = entry.Find("turn")) solid.X_PartSolid = ReadTurn(*turn);
  if (const auto color = entry.Find("color")) solid.color = ReadColor(*color);
  solid.pieces = {solid.whole.Transformed(solid.X_PartSolid)};
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

void PartSolids::ReadPockets(const Value& pockets) {
  for (const auto& [key, entry] : pockets.Entries()) {
    const Pocket& pocket = pockets_.emplace_back(ReadPocket(ReadAnyName(key), entry));
    Solid& solid = solids_[static_cast<std::size_t>(pocket.solid)];
    solid.pieces = Cut(solid.pieces, pocket.box.Transformed(solid.X_PartSolid), entry.At("box"));
  }
}

PartSolids::Pocket PartSolids::ReadPocket(const std::string& name, const Value& entry) const {
  entry.AllowOnly({"cut_from", "box", "widen"});
  Pocket pocket{.name = name,
                .solid = entry.At("cut_from").OneOf(NamesOf(solids_)),
                .box = ReadBox(entry.At("box"))};
  if (const auto widen = entry.Find("widen")) pocket.is_widened = ReadWidening(*widen);
  Widen(entry, pocket);
  return pocket;
}

void PartSolids::Widen(const Value& entry, Pocket& pocket) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!pocket.is_widened[static_cast<std::size_t>(axis)]) continue;
    double& half = pocket.box.half_extents[axis];
    half += clearance_;
    if (2 * half >= kShortestSide) continue;
    entry.At("box").Fail(
        fmt::format("a clearance of {} closes the pocket", InUnit(clearance_, units_.length)),
        "one that leaves a pocket");
  }
}

Box PartSolids::ReadBox(const Value& corners) const {
  const std::vector<Value> items = corners.Items();
  if (items.size() != 2) {
    corners.Fail(fmt::format("a box has two corners, not {}", items.size()),
                 "[[x, y, z], [x, y, z]], the lower corner first");
  }
  const Vector3 low = ReadVector3(items[0], units_);
  const Vector3 high = ReadVector3(items[1], units_);
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] - low[axis] >= kShortestSide) continue;
    corners.Fail(fmt::format("the box has no length along {}", "xyz"[axis]),
                 fmt::format("a second corner at least {} beyond the first",
                             InUnit(kShortestSide, units_.length)));
  }
  return Box::FromCorners(low, high);
}

std::vector<Box> PartSolids::Pieces() const {
  std::vector<Box> pieces;
  for (const Solid& solid : solids_) {
    pieces.insert(pieces.end(), solid.pieces.begin(), solid.pieces.end());
  }
  return pieces;
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

std::vector<const PartSolids::Solid*> PartSolids::SolidsNamed(const Value& names) const {
  return OneOrMore(names, solids_, "solid");
}

std::vector<const PartSolids::Pocket*> PartSolids::PocketsNamed(const Value& names) const {
  return OneOrMore(names, pockets_, "pocket");
}

}  // namespace assay::domain
